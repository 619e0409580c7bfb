#pragma once

#include <cstdint>
#include <vector>

#include "runtime/propagation/global_propagation.h"

namespace lightwell {

/// How a new E becomes a new X.
enum class UpdateMode {
    fresh,        ///< the product with the coefficients of E that weigh most, from nothing
    incremental,  ///< X changes by the product with the changes of E that weigh most (BI)
    per_band,     ///< each band by one of these, whichever is nearer (PBI)
};

struct UpdateOptions {
    UpdateMode mode = UpdateMode::per_band;
    /// Coefficients of E that a frame may multiply. 0: all, and then X is the plain product.
    std::uint32_t budget = 0;
    /// When E has stopped changing, X is exact after so many frames and one more, whatever the
    /// budget; at least 1. Holds for the incremental modes; a fresh update never gets better than
    /// its budget.
    int frames_to_rest = 8;
};

/// What one update did.
struct UpdateReport {
    std::uint32_t coefficients = 0;  ///< multiplied in this frame
    std::uint32_t pending = 0;       ///< coefficients of E that X does not represent yet
    int fresh_bands = 0;             ///< bands that were begun anew
    bool changed = false;            ///< whether X changed at all
};

/// Keeps X = H E up to date while E changes, after Overbeck et al. 2006 (figure 6).
///
/// Bands are the spatial levels of the functions' supports, scaling functions and coarsest wavelets
/// together. With E' the light that X represents, a band for which ||E - E'|| < ||E|| (L1 norm)
/// changes by H (E - E'); else it is begun anew with H E, and leaves no ghost. Of all candidates
/// the budget takes those with the largest |change| times the norm of their column of H; columns
/// without coefficients cost nothing.
///
/// Rounding does not pile up: a band whose changes have come to 20 times its light is multiplied
/// again as it is, and so is everything once at rest. Nothing is allocated after construction.
class IncrementalUpdate {
  public:
    /// Keeps a reference to the propagation. E and X begin as darkness.
    IncrementalUpdate(const RadianceSpace& space, const GlobalPropagation& propagation);

    /// Moves X towards H direct.
    UpdateReport update(const PackedField& direct, const UpdateOptions& options);

    /// X, as far as it has got.
    const PackedField& indirect() const { return indirect_; }
    /// E': the light whose product X is.
    const PackedField& represented() const { return represented_; }
    int bands() const { return static_cast<int>(bands_.size()); }

  private:
    struct Candidate {
        std::uint32_t column;
        float weight;
    };
    struct Band {
        PackedField light;      ///< the band's part of X
        bool is_fresh = false;  ///< begun anew in this frame
        bool is_worn = false;   ///< in need of being multiplied as it is
        double changes = 0;     ///< L1 norm of all that was multiplied since it was exact
    };

    UpdateReport renew(const PackedField& direct);
    void recompute(std::size_t band);
    void sum_bands();
    void decide_fresh_bands(const PackedField& direct, UpdateMode mode);
    void begin_anew(std::size_t band);
    void collect_candidates(const PackedField& direct);
    std::size_t allowed(const UpdateOptions& options) const;
    void choose(std::size_t count);
    void multiply(const PackedField& direct);
    bool has_moved(const PackedField& direct) const;

    const GlobalPropagation& propagation_;
    std::vector<std::uint32_t> columns_;  ///< those of H that are not empty
    std::vector<std::uint8_t> band_;      ///< by basis function
    std::vector<Band> bands_;             ///< their light adds up to indirect_, unless stale
    PackedField indirect_, represented_;
    PackedField previous_;               ///< E of the frame before
    PackedField change_;                 ///< scratch: what is multiplied
    std::vector<Candidate> candidates_;  ///< scratch
    std::vector<std::uint32_t> chosen_;  ///< scratch
    int frames_at_rest_ = 0;
    bool bands_are_stale_ = false;  ///< since X was renewed as a whole
};

}  // namespace lightwell
