// Fuzzes image files of every kind that is read, within the limits of the program and within small ones.
#include "FuzzTargets.h"
#include "core/Exr.h"
#include "core/Image.h"

namespace crevice::fuzz {

void image(std::string_view input) {
    static const ScratchFolder kFolder;
    const std::filesystem::path file = kFolder.write("fuzz.image", input);
    expectAnswer([&] { (void)readImage(file); });
    expectAnswer([&] { (void)readImage(file, smallLimits()); });
    const auto bytes = std::as_bytes(std::span(input));
    if (looksLikeExr(bytes)) expectAnswer([&] { (void)exrColourChannels(bytes, "fuzz.exr", smallLimits()); });
}

}  // namespace crevice::fuzz
