#include "viewer/window/recording.h"

#include <gtest/gtest.h>

#include "radiance4d/failure.h"

namespace lightwell {
namespace {

std::string refusal(const std::string& text) {
    try {
        input_from_text(text, "r.txt");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Recording, DeliversWhatStandsBeforeAFrame) {
    const auto frames = input_from_text(
        "# walk\nsize 320 240\nkey w down\nframes 3 0.5\n\nkey w up\ncursor 10.5 -2\nframe 0.25\n"
        "picture a b.png\n",
        "r.txt");
    ASSERT_EQ(frames.size(), 5u);
    ASSERT_EQ(frames[0].inputs.size(), 2u);
    EXPECT_EQ(std::get<SizeInput>(frames[0].inputs[0]).height, 240);
    EXPECT_EQ(std::get<KeyInput>(frames[0].inputs[1]).key, Key::w);
    EXPECT_TRUE(std::get<KeyInput>(frames[0].inputs[1]).down);
    for (const std::size_t k : {0u, 1u, 2u})
        EXPECT_EQ(frames[k].seconds, 0.5);
    EXPECT_TRUE(frames[1].inputs.empty());
    EXPECT_EQ(std::get<CursorInput>(frames[3].inputs[1]).position, Vec2(10.5, -2));
    EXPECT_EQ(frames[3].seconds, 0.25);
    EXPECT_EQ(std::get<PictureInput>(frames[4].inputs[0]).path, "a b.png");
    EXPECT_EQ(frames[4].seconds, 0);
}

TEST(Recording, WhatIsWrittenIsReadBack) {
    const InputFrame frame{
        1.0 / 60,
        {SizeInput{640, 480}, KeyInput{Key::shift, true}, KeyInput{Key::digit_7, false},
         TextInput{U'?'}, ButtonInput{MouseButton::middle, true}, CursorInput{{1.0 / 3, 2}},
         WheelInput{-1.5}, DropInput{"/a folder/\xc3\xa9.gto"}, FocusLost{},
         PictureInput{"p.exr", false}, PictureInput{"w.png", true}, MemoryInput{"m.txt"}}};
    const std::string text = text_of(frame);
    const auto read = input_from_text(text, "r.txt");
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(text_of(read[0]), text);
    ASSERT_EQ(read[0].inputs.size(), frame.inputs.size());
    for (std::size_t k = 0; k < frame.inputs.size(); ++k)
        EXPECT_EQ(read[0].inputs[k].index(), frame.inputs[k].index());
    EXPECT_EQ(read[0].seconds, frame.seconds);
    EXPECT_EQ(std::get<CursorInput>(read[0].inputs[5]).position[0], 1.0 / 3);
}

TEST(Recording, EveryKeyHasANameOfItsOwn) {
    for (std::size_t k = 1; k < key_count; ++k) {
        const Key key = static_cast<Key>(k);
        EXPECT_EQ(key_named(name_of(key)), key) << name_of(key);
    }
    EXPECT_EQ(key_named("nothing"), Key::unknown);
}

TEST(Recording, RefusesWithLineAndColumn) {
    EXPECT_EQ(refusal("frame 0.1\nkey q sideways\n").rfind("r.txt:2:7: ", 0), 0u);
    EXPECT_EQ(refusal("key nothing down\n").rfind("r.txt:1:5: ", 0), 0u);
    EXPECT_EQ(refusal("frame -1\n").rfind("r.txt:1:7: ", 0), 0u);
    EXPECT_EQ(refusal("frames 9999999999 1\n").rfind("r.txt:1:8: ", 0), 0u);
    EXPECT_EQ(refusal("jump 3\n").rfind("r.txt:1:1: ", 0), 0u);
    EXPECT_EQ(refusal("cursor 1 2 3\n").rfind("r.txt:1:12: ", 0), 0u);
    for (const char* cut : {"key", "key w", "button", "cursor 1", "wheel", "size 4", "drop",
                            "frame", "focus", "text", "size 0 3", "text 0"})
        EXPECT_NE(refusal(cut), "") << cut;
}

}  // namespace
}  // namespace lightwell
