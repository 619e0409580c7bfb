// Stored operators against dense matrices.
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "radiance4d/operator/global_transport.h"
#include "tests/unit/basis/samples.h"

namespace lightwell {
namespace {

using testing::Numbers;

/// A sparse matrix of numbers that floats hold exactly.
Eigen::MatrixXd float_matrix(Numbers& numbers, Eigen::Index n, double largest) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            if (numbers.between(0, 1) < 0.4)
                matrix(i, j) = static_cast<float>(numbers.between(-largest, largest));
    return matrix;
}

SymmetricOperator symmetric_operator(const Eigen::MatrixXd& matrix) {
    const Eigen::MatrixXd upper = matrix.triangularView<Eigen::Upper>();
    return {to_operator(upper.sparseView())};
}

Eigen::MatrixXd symmetric_matrix(Numbers& numbers, Eigen::Index n, double largest) {
    Eigen::MatrixXd matrix = float_matrix(numbers, n, largest);
    matrix.triangularView<Eigen::StrictlyLower>() = matrix.transpose();
    return matrix;
}

TEST(TransportOperator, AppliesAsTheDenseMatrix) {
    Numbers numbers(20);
    const Eigen::MatrixXd dense = float_matrix(numbers, 30, 1);
    const TransportOperator sparse = to_operator(dense.sparseView());
    EXPECT_EQ(sparse.size, 30U);
    EXPECT_EQ(static_cast<Eigen::Index>(sparse.coefficients()), (dense.array() != 0).count());
    Eigen::ArrayXd x = numbers.matrix(30, 1).array();
    x[4] = x[17] = 0;
    const Eigen::ArrayXd start = numbers.matrix(30, 1).array();
    Eigen::ArrayXd y = start;
    sparse.apply(x, y);
    EXPECT_LT((y - start - (dense * x.matrix()).array()).abs().maxCoeff(), 1e-14);
}

TEST(TransportOperator, RefusesFieldsOfAnotherSize) {
    const TransportOperator sparse = to_operator(Eigen::MatrixXd::Identity(4, 4).sparseView());
    Eigen::ArrayXd four = Eigen::ArrayXd::Zero(4), five = Eigen::ArrayXd::Zero(5);
    EXPECT_ANY_THROW(sparse.apply(five, four));
    EXPECT_ANY_THROW(sparse.apply(four, five));
    EXPECT_ANY_THROW(SymmetricOperator{sparse}.apply(five, four));
}

TEST(SymmetricOperator, AppliesBothHalvesAndTheDiagonalOnce) {
    Numbers numbers(21);
    const Eigen::MatrixXd dense = symmetric_matrix(numbers, 25, 1);
    ASSERT_GT(dense.diagonal().cwiseAbs().maxCoeff(), 0.1);
    const SymmetricOperator half = symmetric_operator(dense);
    const Eigen::ArrayXd x = numbers.matrix(25, 1).array();
    const Eigen::ArrayXd start = numbers.matrix(25, 1).array();
    Eigen::ArrayXd y = start;
    half.apply(x, y);
    EXPECT_LT((y - start - (dense * x.matrix()).array()).abs().maxCoeff(), 1e-14);
}

TEST(SymmetricOperator, MatrixScalesColumns) {
    Numbers numbers(22);
    const Eigen::MatrixXd dense = symmetric_matrix(numbers, 25, 1);
    Eigen::ArrayXd scale = numbers.matrix(25, 1, 0, 1).array();
    scale[3] = 0;
    const Eigen::MatrixXd matrix(to_matrix(symmetric_operator(dense), scale));
    EXPECT_LT((matrix - dense * scale.matrix().asDiagonal()).cwiseAbs().maxCoeff(), 1e-15);
}

/// Three elements of a made-up scene, two colours of reflectance, a made-up bounce operator.
struct MadeUp {
    GlobalTransport transport;
    Eigen::MatrixXd bounce;
    RadianceField rho;
    RadianceField direct;

    Eigen::MatrixXd one_bounce(int channel) const {
        return bounce * rho.col(channel).matrix().asDiagonal();
    }
    /// T E + T^2 E + ... of one channel, solved densely.
    Eigen::VectorXd indirect(int channel) const {
        const Eigen::MatrixXd t = one_bounce(channel);
        const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(t.rows(), t.cols()) - t;
        const Eigen::VectorXd e = direct.col(channel).matrix();
        return system.partialPivLu().solve(e) - e;
    }
};

MadeUp made_up() {
    MadeUp made;
    Scene& scene = made.transport.scene;
    std::vector<Element> elements;
    for (int q = 0; q < 3; ++q) {
        Material material;
        material.reflectance = q == 0   ? Rgb(0.9, 0.3, 0.9)
                               : q == 1 ? Rgb(0.5, 0.8, 0.5)
                                        : Rgb(0, 0.6, 0);
        scene.materials.push_back(material);
        scene.quads.push_back({testing::trapezoid(), q, 0, 0});
        Element element;
        element.quad = q;
        element.geometry = testing::trapezoid();
        element.set_space(CellTree({Split::both}), {});
        elements.push_back(element);
    }
    made.transport.space = RadianceSpace(elements);
    Numbers numbers(23);
    const auto n = static_cast<Eigen::Index>(made.transport.space.functions());
    made.bounce = symmetric_matrix(numbers, n, 0.35);
    made.transport.bounce = symmetric_operator(made.bounce);
    made.rho = reflectance_of(scene, made.transport.space);
    made.direct = numbers.matrix(n, 3, 0, 10).array();
    for (const int channel : {0, 1}) {
        const Eigen::MatrixXd t = made.one_bounce(channel);
        const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
        const Eigen::MatrixXd all = (identity - t).inverse();
        made.transport.indirect.push_back(to_operator((all - identity).sparseView()));
    }
    made.transport.channel = {0, 1, 0};
    return made;
}

TEST(GlobalTransport, ReflectanceIsThatOfTheElementsMaterial) {
    const MadeUp made = made_up();
    for (std::uint32_t f = 0; f < made.transport.space.functions(); ++f) {
        const int quad = made.transport.space.element(made.transport.space.element_of(f)).quad;
        EXPECT_TRUE(
            (made.rho.row(f).transpose() == made.transport.scene.material_of(quad).reflectance)
                .all());
    }
}

TEST(GlobalTransport, EmissionLeavesTheSidesThatEmit) {
    Scene scene;
    std::vector<Element> elements;
    for (int q = 0; q < 2; ++q) {
        Material material;
        material.emission = Rgb(1, 2, 3);
        material.emitting = q == 0 ? Sides::front : Sides::both;
        scene.materials.push_back(material);
        scene.quads.push_back({testing::trapezoid(), q, 0, 0});
        for (const bool front : {true, false}) {
            Element element;
            element.quad = q;
            element.front = front;
            element.geometry = front ? testing::trapezoid() : testing::trapezoid().reversed();
            element.set_space(CellTree({Split::u}), {});
            elements.push_back(element);
        }
    }
    const RadianceSpace space(elements);
    const RadianceField emission = emission_of(scene, space);
    const double root = std::sqrt(testing::trapezoid().area());
    for (std::size_t e = 0; e < 4; ++e) {
        const Rgb wanted = e == 1 ? Rgb::Zero() : Rgb(root * Rgb(1, 2, 3));
        EXPECT_LT((emission.row(space.element(e).first).transpose() - wanted).abs().maxCoeff(),
                  1e-14);
        EXPECT_TRUE((emission.row(space.element(e).first + 1) == 0).all());
    }
}

TEST(GlobalTransport, GlobalLightIsDirectPlusStoredIndirect) {
    const MadeUp made = made_up();
    const RadianceField light = global_light(made.transport, made.direct);
    for (int c = 0; c < 3; ++c)
        EXPECT_LT((light.col(c) - made.direct.col(c) - made.indirect(c).array()).abs().maxCoeff(),
                  1e-5)
            << "floats hold the operator";
}

TEST(GlobalTransport, GatheredLightIsOneMoreBounceOfGlobalLight) {
    MadeUp made = made_up();
    // Any H will do: the last bounce is that of the bounce operator.
    Numbers numbers(24);
    made.transport.indirect[0] = to_operator(float_matrix(numbers, 12, 0.5).sparseView());
    const RadianceField light = gathered_light(made.transport, made.direct);
    const RadianceField global = global_light(made.transport, made.direct);
    for (int c = 0; c < 3; ++c)
        EXPECT_LT((light.col(c).matrix() - made.one_bounce(c) * global.col(c).matrix())
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-12);
}

double solved_error(const MadeUp& made, double tolerance) {
    const RadianceField light = solved_light(made.transport, made.direct, tolerance);
    double worst = 0;
    for (int c = 0; c < 3; ++c)
        worst = std::max(worst, (light.col(c).matrix() - made.indirect(c)).cwiseAbs().maxCoeff() /
                                    made.indirect(c).norm());
    return worst;
}

TEST(GlobalTransport, SolvedLightIsTheDenseSolution) {
    EXPECT_LT(solved_error(made_up(), 1e-12), 1e-11);
}

TEST(GlobalTransport, SolvedLightDoesNotNeedAGoodOperator) {
    MadeUp truncated = made_up();
    for (TransportOperator& h : truncated.transport.indirect)
        for (float& value : h.value)
            if (std::abs(value) < 0.1F) value = 0;
    EXPECT_LT(solved_error(truncated, 1e-12), 1e-10);

    MadeUp empty = made_up();
    for (TransportOperator& h : empty.transport.indirect)
        h = to_operator(Eigen::SparseMatrix<double>(12, 12));
    EXPECT_LT(solved_error(empty, 1e-12), 1e-10);

    MadeUp damaged = made_up();
    for (TransportOperator& h : damaged.transport.indirect)
        for (float& value : h.value)
            value = -3 * value;
    EXPECT_LT(solved_error(damaged, 1e-12), 1e-10);
}

}  // namespace
}  // namespace lightwell
