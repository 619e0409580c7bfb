#include "runtime/propagation/global_propagation.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/unit/operator_file/sample_transport.h"

namespace lightwell {
namespace {

/// Two walls of 4,096 cells each: more functions than a block of rows holds. The operators are
/// random, and every fifth column of the first is empty.
GlobalTransport random_transport(std::array<int, 3> channel) {
    GlobalTransport transport;
    std::vector<Element> elements(2);
    for (Element& element : elements) {
        element.geometry = Quad{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 2, 0)}};
        element.set_space(CellTree(std::vector<Split>(6, Split::both)), {});
    }
    elements[1].quad = 1;
    transport.space = RadianceSpace(elements);
    const std::uint32_t size = transport.space.functions();
    for (std::uint32_t seed = 1; seed <= 3; ++seed)
        transport.indirect.push_back(testing::random_operator(size, 20, false, seed));
    transport.channel = channel;
    return transport;
}

PackedField random_light(Eigen::Index size, double share_of_zeros, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    PackedField light = PackedField::Zero(4, size);
    for (Eigen::Index j = 0; j < size; ++j)
        if (static_cast<double>(uniform(random)) >= share_of_zeros)
            light.col(j) = Packed(uniform(random), uniform(random) - 0.5F, uniform(random), 0);
    return light;
}

/// The slow and obvious product, channel by channel.
RadianceField plain_product(const GlobalTransport& transport, const PackedField& light) {
    const RadianceField direct = unpacked(light);
    return global_light(transport, direct) - direct;
}

double relative_difference(const RadianceField& a, const RadianceField& b) {
    return (a - b).matrix().norm() / b.matrix().norm();
}

class OfChannels : public ::testing::TestWithParam<std::array<int, 3>> {};

TEST_P(OfChannels, EqualsThePlainProduct) {
    const GlobalTransport transport = random_transport(GetParam());
    const GlobalPropagation propagation(transport);
    for (const double zeros : {0.0, 0.6, 0.999}) {
        const PackedField light = random_light(propagation.size(), zeros, 7);
        PackedField indirect = PackedField::Constant(4, light.cols(), 1e9);
        propagation.apply(light, indirect);
        EXPECT_LT(relative_difference(unpacked(indirect), plain_product(transport, light)), 3e-7)
            << zeros;
    }
}

INSTANTIATE_TEST_SUITE_P(GlobalPropagation, OfChannels,
                         ::testing::Values(std::array<int, 3>{0, 0, 0}, std::array<int, 3>{0, 1, 0},
                                           std::array<int, 3>{2, 0, 1}));

TEST(GlobalPropagation, DarknessStaysDark) {
    const GlobalTransport transport = random_transport({0, 1, 2});
    const GlobalPropagation propagation(transport);
    PackedField indirect = PackedField::Constant(4, propagation.size(), 3);
    propagation.apply(PackedField::Zero(4, propagation.size()), indirect);
    EXPECT_TRUE((indirect == 0).all());
}

TEST(GlobalPropagation, ReadsNoColumnThatIsNotListed) {
    const GlobalTransport transport = random_transport({0, 1, 2});
    const GlobalPropagation propagation(transport);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    PackedField amount = PackedField::Constant(4, propagation.size(), nan);
    const std::vector<std::uint32_t> listed = {0, 17, 4095, 4096, 8191};
    PackedField light = PackedField::Zero(4, propagation.size());
    for (const std::uint32_t j : listed)
        light.col(j) = amount.col(j) = Packed(1, -2, 3, 0);
    PackedField once = PackedField::Ones(4, propagation.size());
    PackedField also = PackedField::Zero(4, propagation.size());
    propagation.add(listed, amount, once, &also);
    const RadianceField expected = plain_product(transport, light);
    EXPECT_LT(relative_difference(unpacked(once) - 1, expected), 3e-7);
    EXPECT_LT(relative_difference(unpacked(also), expected), 3e-7);
}

TEST(GlobalPropagation, CollectsWhatIsNeitherDarkNorWithoutEffect) {
    const GlobalTransport transport = random_transport({0, 1, 2});
    const GlobalPropagation propagation(transport);
    const PackedField light = random_light(propagation.size(), 0.5, 11);
    std::vector<std::uint32_t> collected = {42}, expected;
    propagation.collect(light, collected);
    for (std::uint32_t j = 0; j < propagation.size(); ++j) {
        bool is_empty = true;
        for (const TransportOperator& channel : transport.indirect)
            is_empty = is_empty && channel.column_start[j] == channel.column_start[j + 1];
        if (!is_empty && (light.col(j) != 0).any()) expected.push_back(j);
    }
    EXPECT_EQ(collected, expected);
}

TEST(GlobalPropagation, GivesTheSameBytesOnOneThreadAndOnMany) {
    const GlobalTransport transport = random_transport({0, 1, 2});
    const GlobalPropagation propagation(transport, ValueFormat::half);
    const PackedField light = random_light(propagation.size(), 0.1, 5);
    PackedField one = PackedField::Zero(4, light.cols()), many = one;
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        propagation.apply(light, one);
    }
    propagation.apply(light, many);
    EXPECT_TRUE((one.topRows<3>() == many.topRows<3>()).all());
}

TEST(GlobalPropagation, EnergyIsTheNormOfAColumn) {
    const GlobalTransport transport = random_transport({0, 1, 1});
    const GlobalPropagation propagation(transport);
    for (const std::uint32_t j : {3U, 4000U, 8000U}) {
        PackedField unit = PackedField::Zero(4, propagation.size());
        unit.col(j) = Packed(1, 1, 1, 0);
        const double norm = plain_product(transport, unit).matrix().norm();
        EXPECT_NEAR(static_cast<double>(propagation.energy()[j]), norm, 1e-6 * norm);
    }
}

/// Largest error of a coefficient and of the largest one of its column, over all columns.
void expect_rounding(ValueFormat format, double relative, double of_largest) {
    const GlobalTransport transport = random_transport({0, 1, 2});
    const GlobalPropagation propagation(transport, format);
    for (std::uint32_t j = 0; j < propagation.size(); j += 97) {
        PackedField unit = PackedField::Zero(4, propagation.size());
        unit.col(j) = Packed(1, 1, 1, 0);
        PackedField column = unit;
        propagation.apply(unit, column);
        const RadianceField exact = plain_product(transport, unit);
        const double largest = exact.abs().maxCoeff();
        const RadianceField excess =
            (unpacked(column) - exact).abs() - relative * exact.abs() - of_largest * largest;
        EXPECT_LE(excess.maxCoeff(), 0) << "column " << j;
    }
}

TEST(GlobalPropagation, HalfFloatsRoundByOnePartIn2048) {
    expect_rounding(ValueFormat::half, 0x1p-11 * 1.001, 0x1p-29);
}

TEST(GlobalPropagation, BytesRoundByOnePartIn254OfTheColumnsLargest) {
    expect_rounding(ValueFormat::byte, 0, 1.0 / 254 * 1.0001);
}

TEST(GlobalPropagation, SmallerFormatsTakeLessMemory) {
    const GlobalTransport transport = random_transport({0, 1, 2});
    const std::uint64_t single = GlobalPropagation(transport).bytes();
    const std::uint64_t half = GlobalPropagation(transport, ValueFormat::half).bytes();
    const std::uint64_t byte = GlobalPropagation(transport, ValueFormat::byte).bytes();
    EXPECT_LT(half, 0.65 * static_cast<double>(single));
    EXPECT_LT(byte, 0.7 * static_cast<double>(half));
}

TEST(GlobalPropagation, CountsPlacesThatChannelsShareOnce) {
    GlobalTransport transport = random_transport({0, 1, 2});
    transport.indirect[1] = transport.indirect[2] = transport.indirect[0];
    EXPECT_EQ(GlobalPropagation(transport).coefficients(), transport.indirect[0].coefficients());
}

}  // namespace
}  // namespace lightwell
