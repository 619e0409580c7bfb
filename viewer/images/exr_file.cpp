#include <cstring>

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include "radiance4d/atomic_file.h"
#include "viewer/images/image_file.h"

namespace lightwell {

namespace {

constexpr int largest_side = 16384;
constexpr const char* unit_attribute = "unit";
constexpr const char* channel_names[] = {"R", "G", "B"};

/// A file in memory, so that what reaches the disk passes through write_atomically alone.
class MemoryStream : public Imf::OStream {
  public:
    MemoryStream() : OStream("memory") {}
    void write(const char* bytes, int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
        std::memcpy(bytes_.data() + position_, bytes, size);
        position_ += size;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
    std::size_t position_ = 0;
};

/// Describes the pixels' memory to OpenEXR, whose interface knows no const.
Imf::FrameBuffer frame_buffer(Image& image, int left, int top) {
    const std::size_t column = sizeof(Image::Pixel);
    const std::size_t row = column * static_cast<std::size_t>(image.width());
    Imf::FrameBuffer buffer;
    for (int channel = 0; channel < 3; ++channel) {
        char* first = reinterpret_cast<char*>(image.pixels().data()) +
                      static_cast<std::size_t>(channel) * sizeof(float);
        buffer.insert(channel_names[channel],
                      Imf::Slice(Imf::FLOAT,
                                 first - static_cast<std::ptrdiff_t>(column) * left -
                                     static_cast<std::ptrdiff_t>(row) * top,
                                 column, row));
    }
    return buffer;
}

Imf::Header header_of(const Image& image, const std::string& unit) {
    Imf::Header header(image.width(), image.height());
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const char* name : channel_names)
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    header.insert("software", Imf::StringAttribute("Lightwell"));
    header.insert(unit_attribute, Imf::StringAttribute(unit));
    Imf::addComments(header, fmt::format("Linear Rec. 709 RGB in {}; luminance is 0.2126 R + "
                                         "0.7152 G + 0.0722 B.",
                                         unit));
    Imf::addChromaticities(header, Imf::Chromaticities());
    // One unit of the numbers is one cd/m2, which other programs read from this attribute.
    if (unit == "cd/m2") Imf::addWhiteLuminance(header, 1.0f);
    return header;
}

}  // namespace

WriteReport write_exr(const Image& image, const std::string& unit, const std::string& path) {
    Image clean = image;
    WriteReport report;
    report.non_finite_pixels = blacken_non_finite(clean);
    MemoryStream stream;
    try {
        // No worker threads: their number must not be seen in the process, nor in the file.
        Imf::OutputFile file(stream, header_of(image, unit), 0);
        file.setFrameBuffer(frame_buffer(clean, 0, 0));
        file.writePixels(image.height());
    } catch (const std::exception& error) {
        throw SystemError(fmt::format("{}: cannot encode OpenEXR: {}", path, error.what()));
    }
    write_atomically(path, stream.bytes());
    return report;
}

ExrPicture read_exr(const std::string& path) {
    try {
        Imf::InputFile file(path.c_str(), 0);
        const Imf::Header& header = file.header();
        const Imath::Box2i window = header.dataWindow();
        const long long width = 1ll + window.max.x - window.min.x;
        const long long height = 1ll + window.max.y - window.min.y;
        if (width > largest_side || height > largest_side)
            throw InputError(fmt::format("{}: {} x {} pixels, more than {} a side", path, width,
                                         height, largest_side));
        if (!file.isComplete()) throw InputError(path + ": the picture is incomplete");
        for (const char* name : channel_names)
            if (!header.channels().findChannel(name))
                throw InputError(fmt::format("{}: has no channel {}", path, name));
        ExrPicture picture{Image(static_cast<int>(width), static_cast<int>(height)), ""};
        file.setFrameBuffer(frame_buffer(picture.image, window.min.x, window.min.y));
        file.readPixels(window.min.y, window.max.y);
        if (const auto* unit = header.findTypedAttribute<Imf::StringAttribute>(unit_attribute))
            picture.unit = unit->value();
        return picture;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(fmt::format("{}: cannot read as OpenEXR: {}", path, error.what()));
    }
}

}  // namespace lightwell
