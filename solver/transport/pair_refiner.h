#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "solver/transport/oracle.h"

namespace lightwell {

/// Heights below this share of a facet's size do not count as in front: they are rounding.
constexpr double coplanar_share = 1e-9;

/// Steps through a record in the order of its visits.
class RecordReader;

/// Told now and then how many links were kept since; may throw to end the refinement.
using LinksKept = std::function<void(std::size_t links)>;

/// Refines the links of one pair of elements, as an oracle says, and records what it decided.
class PairRefiner {
  public:
    /// @param elements  of the scene; they, the oracle and the cost must outlive this
    /// @param root      collects the quads that may stand between the whole elements
    /// @param pair      names the elements
    /// @param receiver, sender  normals of the whole elements
    PairRefiner(const std::vector<Element>& elements, const Oracle& oracle,
                std::function<std::vector<int>()> root, const PairLinks& pair, const Vec3& receiver,
                const Vec3& sender, OracleCost& cost, LinksKept told);

    /// From the whole elements.
    void refine();
    /// The same from what was decided earlier, at no tighter tolerance.
    void go_on_from(const PairRecord& earlier);

    PairLinks take_links();
    PairRecord take_record();

  private:
    /// A link that was refined, with those of the occluders that stand in its way, found when they
    /// are asked for.
    struct Refined {
        Refined* parent = nullptr;
        LinkGeometry geometry;
        std::optional<std::vector<int>> occluders;
    };

    Link whole() const { return {{result_.receiver, {}, {}}, {result_.sender, {}, {}}}; }
    LinkGeometry geometry_of(const Link& link) const;
    void visit(const Link& link, std::vector<int> occluders);
    void revisit(const Link& link, Refined* parent, RecordReader& earlier);
    const std::vector<int>& occluders_of(Refined& link);
    void keep(const LinkGeometry& geometry, const KeptVerdict& verdict, const LinkStrata& strata);

    const std::vector<Element>& elements_;
    const Oracle& oracle_;
    std::function<std::vector<int>()> root_;
    PairLinks result_;
    PairRecord record_;
    OracleCost& cost_;
    LinksKept told_;
    std::size_t links_told_ = 0;
    Vec3 receiver_normal_;
    Vec3 sender_normal_;
};

}  // namespace lightwell
