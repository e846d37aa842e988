// What libFuzzer calls, for the one target that CREVICE_FUZZ_TARGET names.
#include <cstddef>
#include <cstdint>

#include "../FuzzTargets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    crevice::fuzz::CREVICE_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
    return 0;
}
