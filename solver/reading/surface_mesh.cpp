#include "solver/reading/surface_mesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using HalfEdgeMesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

/// A side of a quad, filed under its vertices in ascending order.
struct FiledSide {
    int low, high;
    int quad, side;
    bool ascending;  ///< whether the quad runs along it from low to high

    bool operator<(const FiledSide& other) const {
        return std::tie(low, high, quad, side) <
               std::tie(other.low, other.high, other.quad, other.side);
    }
    bool at_same_place(const FiledSide& other) const {
        return low == other.low && high == other.high;
    }
};

/// Disjoint sets (Tarjan), with the lowest member as each set's name.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int name(int member) {
        while (at(member) != member)
            member = at(member) = at(at(member));
        return member;
    }
    void join(int a, int b) {
        a = name(a);
        b = name(b);
        at(std::max(a, b)) = std::min(a, b);
    }

  private:
    int& at(int member) { return parent_[static_cast<std::size_t>(member)]; }
    std::vector<int> parent_;
};

class MeshBuilder {
  public:
    MeshBuilder(const WeldedQuads& quads, const std::vector<bool>& left_out)
        : quads_(quads),
          left_out_(left_out),
          uses_(4 * quads.corners.size(), 0),
          fans_(4 * quads.corners.size()),
          vertex_of_fan_(4 * quads.corners.size()) {
        built_.flipped.assign(quads.corners.size(), false);
    }

    SurfaceMesh build() {
        file_sides();
        turn_to_face_the_same_way();
        for (const auto& [a, b] : pairs_)
            join_fans(a, b);
        for (int quad = 0; quad < quad_count(); ++quad)
            if (!left_out_[index(quad)]) add_face(quad);
        find_open_sides();
        count_surfaces();
        return std::move(built_);
    }

  private:
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }
    int quad_count() const { return static_cast<int>(quads_.corners.size()); }
    int vertex(int quad, int corner) const {
        return quads_.corners[index(quad)][index(corner % 4)];
    }

    void file_sides() {
        std::vector<FiledSide> sides;
        for (int quad = 0; quad < quad_count(); ++quad)
            for (int side = 0; side < 4 && !left_out_[index(quad)]; ++side) {
                const int from = vertex(quad, side), to = vertex(quad, side + 1);
                if (from != to)
                    sides.push_back(
                        {std::min(from, to), std::max(from, to), quad, side, from < to});
            }
        std::sort(sides.begin(), sides.end());
        for (auto begin = sides.begin(); begin != sides.end();) {
            const auto end = std::find_if(begin, sides.end(), [&](const FiledSide& side) {
                return !side.at_same_place(*begin);
            });
            for (auto side = begin; side != end; ++side)
                uses_[index(4 * side->quad + side->side)] = static_cast<int>(end - begin);
            if (end - begin == 2 && begin->quad != begin[1].quad)
                pairs_.emplace_back(begin[0], begin[1]);
            if (end - begin > 2) ++built_.many_quad_sides;
            begin = end;
        }
    }

    void turn_to_face_the_same_way() {
        std::vector<std::vector<std::pair<int, bool>>> neighbours(index(quad_count()));
        for (const auto& [a, b] : pairs_) {
            const bool differ = a.ascending == b.ascending;
            neighbours[index(a.quad)].emplace_back(b.quad, differ);
            neighbours[index(b.quad)].emplace_back(a.quad, differ);
        }
        std::vector<bool> seen(index(quad_count()), false);
        for (int first = 0; first < quad_count(); ++first) {
            if (seen[index(first)]) continue;
            std::vector<int> surface = {first};
            seen[index(first)] = true;
            int turned = 0;
            for (std::size_t i = 0; i < surface.size(); ++i) {
                const int quad = surface[i];
                if (built_.flipped[index(quad)]) ++turned;
                for (const auto& [next, differ] : neighbours[index(quad)]) {
                    if (seen[index(next)]) continue;
                    seen[index(next)] = true;
                    built_.flipped[index(next)] = built_.flipped[index(quad)] != differ;
                    surface.push_back(next);
                }
            }
            if (2 * turned > static_cast<int>(surface.size()))
                for (const int quad : surface)
                    built_.flipped[index(quad)] = !built_.flipped[index(quad)];
        }
    }

    /// The number of the corner of a quad that is a vertex of one of its sides.
    int corner(const FiledSide& side, int of_vertex) const {
        const bool at_start = vertex(side.quad, side.side) == of_vertex;
        return 4 * side.quad + (at_start ? side.side : (side.side + 1) % 4);
    }

    /// Joins the fans at both ends of a side, unless its two quads cannot face the same way (as
    /// somewhere on a Moebius strip).
    void join_fans(const FiledSide& a, const FiledSide& b) {
        const bool a_runs_up = a.ascending != built_.flipped[index(a.quad)];
        const bool b_runs_up = b.ascending != built_.flipped[index(b.quad)];
        if (a_runs_up == b_runs_up) return;
        fans_.join(corner(a, a.low), corner(b, a.low));
        fans_.join(corner(a, a.high), corner(b, a.high));
    }

    void add_face(int quad) {
        std::vector<HalfEdgeMesh::VertexHandle> ring;
        std::vector<int> side_of;  // the quad's side that leaves each vertex of the ring
        const bool turned = built_.flipped[index(quad)];
        for (int i = 0; i < 4; ++i) {
            const int here = turned ? 3 - i : i;
            const int next = turned ? (here + 3) % 4 : (here + 1) % 4;
            if (vertex(quad, here) == vertex(quad, next)) continue;
            ring.push_back(mesh_vertex(4 * quad + here));
            side_of.push_back(turned ? next : here);
        }
        if (ring.size() < 3) return;
        if (!fits(ring))
            for (auto& corner : ring)
                corner = mesh_.add_vertex(mesh_.point(corner));
        const auto face = mesh_.add_face(ring);
        LIGHTWELL_CHECK(face.is_valid());
        auto half_edge = mesh_.find_halfedge(ring[0], ring[1]);
        for (const int side : side_of) {
            side_of_half_edge_.resize(mesh_.n_halfedges(), -1);
            side_of_half_edge_[index(half_edge.idx())] = 4 * quad + side;
            half_edge = mesh_.next_halfedge_handle(half_edge);
        }
    }

    HalfEdgeMesh::VertexHandle mesh_vertex(int corner) {
        auto& handle = vertex_of_fan_[index(fans_.name(corner))];
        if (!handle.is_valid()) {
            const Vec3& place = quads_.vertices[index(vertex(corner / 4, corner % 4))];
            handle = mesh_.add_vertex({place[0], place[1], place[2]});
        }
        return handle;
    }

    /// Whether a face can join the mesh at these vertices and leave it a surface. OpenMesh would
    /// refuse it with a message of its own on the terminal.
    bool fits(const std::vector<HalfEdgeMesh::VertexHandle>& ring) const {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (!mesh_.is_boundary(ring[i])) return false;
            const auto half_edge = mesh_.find_halfedge(ring[i], ring[(i + 1) % ring.size()]);
            if (half_edge.is_valid() && !mesh_.is_boundary(half_edge)) return false;
        }
        return true;
    }

    void find_open_sides() {
        std::vector<int> open;
        for (const auto half_edge : mesh_.halfedges()) {
            if (mesh_.is_boundary(half_edge) ||
                !mesh_.is_boundary(mesh_.opposite_halfedge_handle(half_edge)))
                continue;
            const int side = side_of_half_edge_[index(half_edge.idx())];
            if (uses_[index(side)] == 1) open.push_back(side);
        }
        std::sort(open.begin(), open.end());
        for (const int side : open)
            built_.open_sides.push_back({side / 4, side % 4});
    }

    void count_surfaces() {
        std::vector<bool> seen(mesh_.n_faces(), false);
        for (const auto first : mesh_.faces()) {
            if (seen[index(first.idx())]) continue;
            bool closed = true;
            std::vector<HalfEdgeMesh::FaceHandle> waiting = {first};
            seen[index(first.idx())] = true;
            while (!waiting.empty()) {
                const auto face = waiting.back();
                waiting.pop_back();
                closed = closed && !mesh_.is_boundary(face);
                for (const auto next : mesh_.ff_range(face))
                    if (!seen[index(next.idx())]) {
                        seen[index(next.idx())] = true;
                        waiting.push_back(next);
                    }
            }
            ++built_.surfaces;
            if (closed) ++built_.closed_surfaces;
        }
    }

    const WeldedQuads& quads_;
    const std::vector<bool>& left_out_;
    std::vector<int> uses_;  ///< by how many quads each side (4 * quad + side) is shared
    std::vector<std::pair<FiledSide, FiledSide>> pairs_;
    DisjointSets fans_;
    HalfEdgeMesh mesh_;
    std::vector<HalfEdgeMesh::VertexHandle> vertex_of_fan_;
    std::vector<int> side_of_half_edge_;
    SurfaceMesh built_;
};

}  // namespace

SurfaceMesh surface_mesh(const WeldedQuads& quads, const std::vector<bool>& left_out) {
    return MeshBuilder(quads, left_out).build();
}

}  // namespace lightwell
