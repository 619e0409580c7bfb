#include "solver/transport/pair_refiner.h"

#include "solver/transport/kernel_samples.h"

namespace lightwell {

namespace {

/// Sets the facets of a link: what each support shows to the other. False where they do not face at
/// all.
bool face_each_other(LinkGeometry& link) {
    const Quad x = link.receiver->cell(link.link.receiver.space);
    const Quad y = link.sender->cell(link.link.sender.space);
    const Facet whole_x = Facet::of(x, link.receiver_facet.normal);
    const Facet whole_y = Facet::of(y, link.sender_facet.normal);
    const double tolerance = coplanar_share * (whole_x.reach() + whole_y.reach());
    link.receiver_facet =
        whole_x.in_front_of(whole_y.normal, whole_y.normal.dot(y.vertex[0]), tolerance);
    if (link.receiver_facet.empty()) return false;
    link.sender_facet =
        whole_y.in_front_of(whole_x.normal, whole_x.normal.dot(x.vertex[0]), tolerance);
    return !link.sender_facet.empty();
}

/// The supports that one end of a link is refined into: children in space, in angle, in both or in
/// neither.
std::vector<Support> refined(const Support& support, const Element& element, bool in_space,
                             bool in_angle) {
    std::vector<Support> result = {support};
    const auto split = [&result](const CellTree& tree, Cell Support::*part) {
        std::vector<Support> finer;
        for (const Support& coarse : result) {
            for (std::uint32_t c = 0; c < tree.children((coarse.*part).level); ++c) {
                Support child = coarse;
                child.*part = tree.child(coarse.*part, c);
                finer.push_back(child);
            }
        }
        result = std::move(finer);
    };
    if (in_space) split(element.space.tree(), &Support::space);
    if (in_angle) split(element.angle, &Support::angle);
    return result;
}

/// Acts on what a link is refined into in the named sub-domains.
template <class Act>
void for_each_child(const LinkGeometry& geometry, unsigned sides, const Act& act) {
    const std::vector<Support> senders =
        refined(geometry.link.sender, *geometry.sender, (sides & sender_space) != 0,
                (sides & sender_angle) != 0);
    for (const Support& receiver :
         refined(geometry.link.receiver, *geometry.receiver, (sides & receiver_space) != 0,
                 (sides & receiver_angle) != 0))
        for (const Support& sender : senders)
            act({receiver, sender});
}

}  // namespace

class RecordReader {
  public:
    explicit RecordReader(const PairRecord& record) : record_(record) {}

    std::uint8_t next_step() { return record_.steps[step_++]; }
    const KeptVerdict& next_verdict() { return record_.verdicts[verdict_++]; }
    double next_exchange() { return record_.exchange[exchange_++]; }

  private:
    const PairRecord& record_;
    std::size_t step_ = 0, verdict_ = 0, exchange_ = 0;
};

PairRefiner::PairRefiner(const std::vector<Element>& elements, const Oracle& oracle,
                         std::function<std::vector<int>()> root, const PairLinks& pair,
                         const Vec3& receiver, const Vec3& sender, OracleCost& cost, LinksKept told)
    : elements_(elements),
      oracle_(oracle),
      root_(std::move(root)),
      cost_(cost),
      told_(std::move(told)),
      receiver_normal_(receiver),
      sender_normal_(sender) {
    result_.receiver = pair.receiver;
    result_.sender = pair.sender;
    record_.sender = pair.sender;
}

void PairRefiner::refine() {
    visit(whole(), root_());
}

void PairRefiner::go_on_from(const PairRecord& earlier) {
    RecordReader reader(earlier);
    revisit(whole(), nullptr, reader);
}

PairLinks PairRefiner::take_links() {
    told_(result_.links.size() - links_told_);
    result_.links.shrink_to_fit();
    return std::move(result_);
}

PairRecord PairRefiner::take_record() {
    record_.steps.shrink_to_fit();
    record_.verdicts.shrink_to_fit();
    record_.exchange.shrink_to_fit();
    return std::move(record_);
}

LinkGeometry PairRefiner::geometry_of(const Link& link) const {
    LinkGeometry geometry;
    geometry.link = link;
    geometry.receiver = &elements_[link.receiver.element];
    geometry.sender = &elements_[link.sender.element];
    geometry.receiver_facet.normal = receiver_normal_;
    geometry.sender_facet.normal = sender_normal_;
    geometry.receiver_finest = geometry.receiver->space.tree().is_finest(link.receiver.space);
    geometry.sender_finest = geometry.sender->space.tree().is_finest(link.sender.space);
    return geometry;
}

void PairRefiner::visit(const Link& link, std::vector<int> occluders) {
    LinkGeometry geometry = geometry_of(link);
    LinkStrata strata;
    Verdict verdict;
    if (face_each_other(geometry)) verdict = oracle_.judge(geometry, occluders, strata, cost_);
    switch (verdict.act) {
        case Verdict::Act::drop:
            record_.steps.push_back(PairRecord::nothing);
            return;
        case Verdict::Act::keep:
            keep(geometry, verdict.kept, strata);
            return;
        case Verdict::Act::refine:
            record_.steps.push_back(static_cast<std::uint8_t>(verdict.sub_domains));
            for_each_child(geometry, verdict.sub_domains,
                           [&](const Link& child) { visit(child, occluders); });
            return;
    }
}

void PairRefiner::revisit(const Link& link, Refined* parent, RecordReader& earlier) {
    const std::uint8_t step = earlier.next_step();
    if (step == PairRecord::nothing) {
        record_.steps.push_back(step);
        return;
    }
    Refined here{parent, geometry_of(link), {}};
    if (step != PairRecord::kept) {
        record_.steps.push_back(step);
        for_each_child(here.geometry, step,
                       [&](const Link& child) { revisit(child, &here, earlier); });
        return;
    }
    const KeptVerdict& verdict = earlier.next_verdict();
    LinkStrata strata;
    strata.sampled = verdict.rays > 0;
    const LinkChildren children = children_of(here.geometry);
    for (int i = 0; i < children.receivers; ++i)
        for (int j = 0; j < children.senders; ++j)
            strata.exchange[i][j] = earlier.next_exchange();
    if (oracle_.keeps(verdict))
        keep(here.geometry, verdict, strata);
    else
        visit(link, parent != nullptr ? occluders_of(*parent) : root_());
}

const std::vector<int>& PairRefiner::occluders_of(Refined& link) {
    if (!link.occluders) {
        link.occluders = link.parent != nullptr ? occluders_of(*link.parent) : root_();
        face_each_other(link.geometry);
        oracle_.strike_out(link.geometry, *link.occluders);
    }
    return *link.occluders;
}

void PairRefiner::keep(const LinkGeometry& geometry, const KeptVerdict& verdict,
                       const LinkStrata& strata) {
    record_.steps.push_back(PairRecord::kept);
    record_.verdicts.push_back(verdict);
    const LinkChildren children = children_of(geometry);
    for (int i = 0; i < children.receivers; ++i) {
        for (int j = 0; j < children.senders; ++j) {
            const double exchange = strata.exchange[i][j];
            record_.exchange.push_back(exchange);
            if (!(exchange > 0)) continue;
            result_.links.emplace_back(
                geometry.receiver->space.tree().position(children.receiver[i]),
                geometry.sender->space.tree().position(children.sender[j]), exchange,
                strata.sampled);
        }
    }
    constexpr std::size_t links_between = 4096;
    if (result_.links.size() < links_told_ + links_between) return;
    told_(result_.links.size() - links_told_);
    links_told_ = result_.links.size();
}

}  // namespace lightwell
