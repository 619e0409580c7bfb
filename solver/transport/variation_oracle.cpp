#include "solver/transport/variation_oracle.h"

#include "solver/transport/kernel_samples.h"

namespace lightwell {

VariationOracle::VariationOracle(const VariationOracleOptions& options,
                                 const Visibility& visibility)
    : options_(options), visibility_(visibility) {}

Verdict VariationOracle::judge(const LinkGeometry& link, std::vector<int>& /*occluders*/,
                               LinkStrata& strata, OracleCost& cost) const {
    ++cost.links_judged;
    const LinkChildren children = children_of(link);
    const int strata_count = children.receivers * children.senders;
    const StratifiedSamples samples = sample_strata(
        link, children, (options_.samples + strata_count - 1) / strata_count, 0, visibility_, cost);
    if (samples.highest == 0) return {};

    const double spread = samples.highest - samples.lowest;
    const double area_x = link.receiver->space.area(link.link.receiver.space);
    const double area_y = link.sender->space.area(link.link.sender.space);
    unsigned sides = 0;
    if (!link.sender_finest && spread * area_y > options_.sender_threshold) sides |= sender_space;
    if (!link.receiver_finest && spread * area_x > options_.receiver_threshold)
        sides |= receiver_space;
    if (sides != 0) return {Verdict::Act::refine, sides, {}};

    const OpenShares open = open_shares(link, children);
    for (int i = 0; i < children.receivers; ++i)
        for (int j = 0; j < children.senders; ++j)
            strata.exchange[i][j] = samples.kernel[i][j] * samples.seen[i][j] *
                                    link.receiver->cell(children.receiver[i]).area() *
                                    open.receiver[i] *
                                    link.sender->cell(children.sender[j]).area() * open.sender[j];
    strata.sampled = true;
    return {Verdict::Act::keep, 0, {}};
}

}  // namespace lightwell
