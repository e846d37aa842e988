// Ray-traced maps on disk by content: a map of the same scene, view and settings is not traced twice.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "truth/AmbientReference.h"
#include "truth/HeightfieldReference.h"

namespace crevice {

/// Content hash of all that the map depends on: what rays meet (positions, normals, indices, transforms, alpha tests),
/// camera, size, terms, rays, seed and a version. Names, colours, lights and the number of threads do not matter.
std::string truthKey(const Scene& scene, const Camera& camera, const glm::uvec2& size, const AmbientSettings& settings);

/// Fills depth, normals, mask and the halves of a map of the right size and layers. False when there is none; damaged
/// files count as absent.
bool loadTruth(const std::filesystem::path& folder, const std::string& key, AmbientMap& map);
/// Writes aside, then renames. A folder that cannot be written is no error.
void storeTruth(const std::filesystem::path& folder, const std::string& key, const AmbientMap& map);

/// The same for heightfields: of depth, normals, mask, camera and settings.
std::string heightfieldKey(const HeightfieldInput& input, const HeightfieldSettings& settings);
/// `map` has the right size.
bool loadHeightfield(const std::filesystem::path& folder, const std::string& key, std::vector<float>& map);
void storeHeightfield(const std::filesystem::path& folder, const std::string& key, const std::vector<float>& map);

}  // namespace crevice
