#include "viewer/window/first_look.h"

#include <cstdint>
#include <limits>
#include <utility>

#include "solver/transport/elements.h"

namespace lightwell {

GlobalTransport first_look(const Scene& scene) {
    GlobalTransport transport;
    transport.scene = scene;
    std::uint64_t blind = 0;
    std::vector<Element> elements = seeing_elements(scene, blind);
    set_cells(elements, std::numeric_limits<double>::max(), 0);
    transport.space = RadianceSpace(std::move(elements));
    TransportOperator nothing;
    nothing.size = transport.space.functions();
    nothing.column_start.assign(nothing.size + std::size_t{1}, 0);
    transport.bounce.upper = nothing;
    transport.indirect = {std::move(nothing)};
    return transport;
}

bool is_computed(const GlobalTransport& transport) {
    return transport.provenance.error_asked > 0;
}

}  // namespace lightwell
