#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "radiance4d/scene/light.h"

namespace lightwell {

/// A light as it is edited: what it is, and how it is switched.
struct EditedLight {
    Light light;
    bool on = true;
    double dimmer = 1;  ///< factor of its intensity, >= 0
};

/// The same light with another position, intensity or name.
void set_position(Light& light, const Vec3& position);
void set_intensity(Light& light, const Rgb& intensity);
void set_name(Light& light, const std::string& name);
const Rgb& full_intensity_of(const Light& light);
/// The light in another colour: as bright as before, by its brightest channel, with the hue of
/// `wanted`. Black is no hue, and changes nothing.
void set_hue(Light& light, const Rgb& wanted);
/// A light of the other kind in the same place; a point light that becomes a spot shines along
/// `direction` (unit length).
Light other_kind(const Light& light, const Vec3& direction);

/// The lights of a scene while they are edited, with undo and redo.
class LightEdits {
  public:
    LightEdits() = default;
    explicit LightEdits(const std::vector<Light>& lights);
    explicit LightEdits(std::vector<EditedLight> lights) : lights_(std::move(lights)) {}

    const std::vector<EditedLight>& lights() const { return lights_; }
    /// Those that are on, dimmed: what light projection takes.
    std::vector<Light> shining() const;

    /// Adds a light under a name that no other one has, after the others. @return its index
    std::size_t add(const EditedLight& light);
    /// Replaces all lights.
    void replace(const std::vector<EditedLight>& lights);
    void remove(std::size_t index);
    /// Changes a light. Changes that follow each other count as one for undo, until settle():
    /// dragging passes through hundreds of places that nobody wants back.
    void change(std::size_t index, const EditedLight& light);
    /// The next change is one of its own.
    void settle() { is_changing_ = false; }

    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    /// Does nothing where nothing is left to undo, or to redo.
    void undo();
    void redo();

  private:
    using Lights = std::vector<EditedLight>;

    void remember();

    Lights lights_;
    std::vector<Lights> past_, future_;  ///< the most recent last
    bool is_changing_ = false;
};

}  // namespace lightwell
