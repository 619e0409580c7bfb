#include "runtime/propagation/fitting_format.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// One column of n ones and then the values given.
GlobalTransport column_of(std::uint32_t ones, const std::vector<float>& then) {
    TransportOperator channel;
    channel.size = ones + static_cast<std::uint32_t>(then.size());
    channel.value.assign(ones, 1.0F);
    channel.value.insert(channel.value.end(), then.begin(), then.end());
    channel.column_start.assign(channel.size + 1, channel.value.size());
    channel.column_start[0] = 0;
    for (std::uint32_t k = 0; k < channel.size; ++k)
        channel.row.push_back(k);
    GlobalTransport transport;
    transport.indirect.push_back(channel);
    return transport;
}

FormatPolicy for_any_size() {
    FormatPolicy policy;
    policy.cached_bytes = 0;
    return policy;
}

TEST(FittingFormat, RoundingIsTheNormOfWhatIsLost) {
    // A byte holds whole 127ths of the largest value.
    const GlobalTransport transport = column_of(99, {0.4F / 127});
    EXPECT_NEAR(rounding_of(transport, ValueFormat::byte), 0.4 / 127 / std::sqrt(99), 1e-8);
    EXPECT_EQ(rounding_of(transport, ValueFormat::single), 0);
    const double half = rounding_of(column_of(1, {1 + 0x1p-12F}), ValueFormat::half);
    EXPECT_NEAR(half, 0x1p-12 / std::sqrt(2), 1e-6);
    EXPECT_EQ(rounding_of(column_of(3, {}), ValueFormat::byte), 0);
}

TEST(FittingFormat, IsTheSmallestThatTheErrorAllows) {
    // Bytes change this one by 0.28 %, half floats by 0.005 %.
    GlobalTransport transport = column_of(1, std::vector<float>(50, 0.5F / 127 * 0.999F));
    const double byte = rounding_of(transport, ValueFormat::byte);
    const double half = rounding_of(transport, ValueFormat::half);
    ASSERT_LT(half, byte / 10);
    transport.provenance.error_asked = 10.1 * byte;
    EXPECT_EQ(fitting_format(transport, for_any_size()), ValueFormat::byte);
    transport.provenance.error_estimated = 9.9 * byte;
    EXPECT_EQ(fitting_format(transport, for_any_size()), ValueFormat::half);
    transport.provenance.error_estimated = 9.9 * half;
    EXPECT_EQ(fitting_format(transport, for_any_size()), ValueFormat::single);
}

TEST(FittingFormat, KeepsWhatIsSmallOrOfUnknownErrorAsItIs) {
    GlobalTransport transport = column_of(1, std::vector<float>(50, 0.5F / 127));
    EXPECT_EQ(fitting_format(transport, for_any_size()), ValueFormat::single);
    transport.provenance.error_asked = 0.5;
    EXPECT_EQ(fitting_format(transport, for_any_size()), ValueFormat::byte);
    EXPECT_EQ(fitting_format(transport), ValueFormat::single);
}

}  // namespace
}  // namespace lightwell
