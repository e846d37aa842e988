// Gives memory back to the system piece by piece, while the rest of an array is still in use.
#pragma once

#include <cstddef>
#include <span>

namespace crevice {

/// The whole pages inside `bytes` are given back: they read as zeros from then on and may be written anew. Bytes that
/// share a page with others stay. Does nothing where the system cannot.
void releasePages(std::span<std::byte> bytes);

}  // namespace crevice
