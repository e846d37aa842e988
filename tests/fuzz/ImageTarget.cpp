// Fuzzes image files of every kind that is read.
#include "FuzzTargets.h"
#include "core/Image.h"

namespace crevice::fuzz {

void image(std::string_view input) {
    static const ScratchFolder kFolder;
    const std::filesystem::path file = kFolder.write("fuzz.image", input);
    expectAnswer([&] { (void)readImage(file); });
}

}  // namespace crevice::fuzz
