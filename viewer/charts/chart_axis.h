#pragma once

#include <string>
#include <vector>

namespace lightwell {

/// A logarithmic or linear axis from one pixel to another.
class ChartAxis {
  public:
    enum class Scale { logarithmic, linear };

    /// @param lowest, highest  values to be shown; > 0 on a logarithmic axis
    ChartAxis(double lowest, double highest, double from, double to,
              Scale scale = Scale::logarithmic);

    /// Pixel of a value.
    double at(double value) const;
    double lowest() const { return value_of(low_); }
    double highest() const { return value_of(high_); }

    /// Round values on the axis, as few as make at least four if that can be had: powers of ten; 1,
    /// 2 and 5 times these; 1 to 9 times, then in steps of 0.5 and 0.2. Whole numbers on a linear
    /// axis.
    std::vector<double> ticks() const;

  private:
    double on_scale(double value) const;
    double value_of(double on_scale) const;

    Scale scale_;
    double low_, high_, from_, to_;
};

/// A value in a few letters: 0.05, 20, 5000, 20 k, 1.5 M.
std::string tick_text(double value);

}  // namespace lightwell
