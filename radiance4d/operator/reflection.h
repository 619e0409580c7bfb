#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "radiance4d/basis/angular_reflection.h"
#include "radiance4d/operator/radiance_field.h"
#include "radiance4d/operator/transport_operator.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// R: what every element makes of incident radiance. One bounce is T = P R, with P the colourless
/// propagation between elements (DESIGN: T = P R; WRT eq. 3). R acts on directions alone, at each
/// spatial function by itself: the diffuse part keeps the mean and spreads it evenly, the lobe is
/// the material's AngularReflection at the element's angular levels. An element without angular
/// functions reflects by the mean albedo of its material.
class Reflection {
  public:
    /// Of no element.
    Reflection() = default;
    /// @param lobes  of the scene, as far as they are computed already; empty: none is
    Reflection(const Scene& scene, const RadianceSpace& space, const SceneLobes& lobes = {});

    /// Eight fields of one channel side by side: one row per basis function of a list.
    using Fields = Eigen::Array<float, Eigen::Dynamic, 8, Eigen::RowMajor>;
    /// Basis functions, ascending.
    using Functions = std::vector<std::uint32_t>;

    /// R x: outgoing radiance, in the same basis, per channel.
    RadianceField outgoing(const RadianceField& incident) const;
    /// R x between some functions: what becomes, in the functions `to`, of light in the functions
    /// `from`. For fields of one channel that mixes red, green and blue by shares that add up to
    /// one.
    ///
    /// @param incident  a row for each function of `from`
    /// @param outgoing  is made to have a row for each function of `to`; not `incident` itself
    void reflect(const Rgb& shares, const Functions& from, const Fields& incident,
                 const Functions& to, Fields& outgoing) const;
    /// R of such a channel as a matrix, without the coefficients below `smallest`.
    ///
    /// @param leaving  by basis function: whether its row is wanted; the others are left empty
    Eigen::SparseMatrix<double> matrix(const Rgb& shares, double smallest,
                                       const std::vector<bool>& leaving) const;
    /// By basis function: norm of what becomes of it, relative to that of the angular mean, at most
    /// one. Light that differs only in functions of which little is reflected looks the same.
    Eigen::ArrayXd visibility(const Rgb& shares) const;
    /// Whether two channels are reflected alike by every element.
    bool are_alike(int channel, int other) const;

  private:
    /// What an element does; the lobe is index `lobe` into lobes_, -1 without one.
    struct OfElement {
        Eigen::Index first = 0, cells = 0, angles = 0;  ///< its basis functions
        Rgb diffuse = Rgb::Zero();
        Rgb specular = Rgb::Zero();
        int lobe = -1;
    };
    /// R of one channel between the angular functions of an element.
    struct BetweenAngles {
        double diffuse = 0, specular = 0;
        const RowMatrix* lobe = nullptr;  ///< null without one

        /// From function `b` to `a`.
        double operator()(Eigen::Index a, Eigen::Index b) const {
            const double directed = lobe != nullptr ? specular * (*lobe)(a, b) : 0;
            return a == 0 && b == 0 ? directed + diffuse : directed;
        }
    };
    BetweenAngles between_angles(const OfElement& element, const Rgb& shares) const;

    /// A lobe in single precision, by where light leaves, then by where it arrives.
    using Response = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    std::uint32_t functions_ = 0;
    std::vector<AngularReflection> lobes_;
    std::vector<Response> responses_;  ///< of each lobe
    std::vector<OfElement> of_element_;
};

/// Light that was reflected at least once, T (E + T E + ...) with T = P R: the fixed point of
/// B = P R (E + B), by iteration until B changes by less than `tolerance` of itself.
RadianceField bounced_light(const SymmetricOperator& propagation, const Reflection& reflection,
                            const RadianceField& direct, double tolerance = 1e-6);

}  // namespace lightwell
