#include "runtime/propagation/packed_field.h"

namespace lightwell {

PackedField packed(const RadianceField& field) {
    PackedField result = PackedField::Zero(4, field.rows());
    result.topRows<3>() = field.cast<float>().transpose();
    return result;
}

RadianceField unpacked(const PackedField& field) {
    return field.topRows<3>().cast<double>().transpose();
}

}  // namespace lightwell
