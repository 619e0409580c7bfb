#include "runtime/outgoing/eye_radiance.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace lightwell {

namespace {

using Means = Eigen::Array<double, Eigen::Dynamic, 3>;

CellTree cut_finer(const CellTree& tree, int finer) {
    std::vector<Split> splits = tree.splits();
    splits.insert(splits.end(), static_cast<std::size_t>(finer), Split::both);
    return CellTree(splits);
}

/// Cells that nobody sees, under what stands there, take the light of those around them, ring by
/// ring.
void fill_unseen(const CellTree& tree, std::vector<char> seen, Means& indirect, Means& emitted) {
    const auto columns = static_cast<int>(tree.columns()), rows = static_cast<int>(tree.rows());
    const auto cell = [&](int i, int j) {
        return tree.finest_at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
    };
    for (bool grows = true; grows;) {
        grows = false;
        std::vector<char> next = seen;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                if (seen[cell(i, j)] != 0) continue;
                Rgb sum = Rgb::Zero(), sum_emitted = Rgb::Zero();
                int count = 0;
                for (int y = std::max(0, j - 1); y <= std::min(rows - 1, j + 1); ++y)
                    for (int x = std::max(0, i - 1); x <= std::min(columns - 1, i + 1); ++x) {
                        if (seen[cell(x, y)] == 0) continue;
                        sum += indirect.row(cell(x, y)).transpose();
                        sum_emitted += emitted.row(cell(x, y)).transpose();
                        ++count;
                    }
                if (count == 0) continue;
                indirect.row(cell(i, j)) = (sum / count).transpose();
                emitted.row(cell(i, j)) = (sum_emitted / count).transpose();
                next[cell(i, j)] = 1;
                grows = true;
            }
        seen = std::move(next);
    }
}

}  // namespace

EyeRadiance::EyeRadiance(const RadianceSpace& space, const Vec3& eye, int finer, const Look& look,
                         const std::function<void()>& check)
    : element_(space.elements().size()) {
    for (std::size_t e = 0; e < element_.size(); ++e) {
        const Element& element = space.element(e);
        if (element.angle.levels() == 0 ||
            !(element.geometry.normal().dot(eye - element.geometry.vertex[0]) > 0))
            continue;
        const CellTree tree = cut_finer(element.space.tree(), finer);
        Means indirect = Means::Zero(tree.functions(), 3), emitted = indirect;
        std::vector<char> seen(tree.functions(), 1);
        tbb::parallel_for(std::uint32_t{0}, tree.functions(), [&](std::uint32_t m) {
            check();
            const ParameterRect r = tree.rect({tree.levels(), m});
            const Vec2 uv(0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1));
            if (!element.is_sample_open(uv[0], uv[1])) {
                seen[m] = 0;
                return;
            }
            const Vec3 point = element.geometry.point(uv[0], uv[1]);
            const GatheredRadiance light = look(e, point, (eye - point).normalized());
            indirect.row(m) = light.indirect.transpose();
            emitted.row(m) = light.emitted.transpose();
        });
        fill_unseen(tree, std::move(seen), indirect, emitted);
        element_[e] = Seen{SmoothSurface(tree, indirect), SmoothSurface(tree, emitted)};
    }
}

GatheredRadiance EyeRadiance::at(std::size_t element, const Vec2& uv) const {
    const Seen& seen = *element_[element];
    return {seen.indirect.at(uv[0], uv[1]), seen.emitted.at(uv[0], uv[1])};
}

}  // namespace lightwell
