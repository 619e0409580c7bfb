#pragma once

#include <cstddef>
#include <string>

#include "viewer/images/image.h"

namespace lightwell {

enum class ImageFormat { png, exr };

/// The format that a file name's extension asks for, in either case of letters.
/// @throws InputError for any other extension.
ImageFormat image_format(const std::string& path);

/// What was done to a picture on its way into a file.
struct WriteReport {
    /// Pixels with a NaN or infinite component, which was written as 0.
    std::size_t non_finite_pixels = 0;
};

/// Writes 8-bit RGB, sRGB-encoded and marked so. The image is the linear light of a display:
/// components below 0 are written as 0, above 1 as 1.
/// @throws as write_atomically.
[[nodiscard]] WriteReport write_png(const Image& image, const std::string& path);

/// Writes the channels R, G, B as 32-bit floats, ZIP-compressed, with the unit of the numbers
/// ("cd/m2", "lx") in the attribute `unit`, and Rec. 709 chromaticities. Floats, because a sunlit
/// scene exceeds the largest half float, 65504.
/// @throws as write_atomically.
[[nodiscard]] WriteReport write_exr(const Image& image, const std::string& unit,
                                    const std::string& path);

/// The picture that write_exr wrote, with its unit. For files that can be trusted: it is as safe as
/// the OpenEXR library, after a limit of 16384 pixels a side.
struct ExrPicture {
    Image image;
    std::string unit;  ///< "" where the file does not say
};
/// @throws InputError if the file is not a complete OpenEXR picture with the channels R, G, B.
ExrPicture read_exr(const std::string& path);

}  // namespace lightwell
