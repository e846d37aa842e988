// Materials and pictures of a scene that is drawn with a Cocos project: .mtl files and those of glTF.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "cocos/assets/MtlInstance.h"
#include "cocos/assets/Project.h"
#include "core/Log.h"
#include "scene/Scene.h"

namespace crevice::cocos {

/// How materials are written down: as effects of the project, for pipelines with a Cocos profile, or as plain numbers
/// for our own effects.
enum class MaterialForm { Effects, Plain };

/// Adds materials and textures to one scene, each once.
class SceneMaterials {
public:
    SceneMaterials(Project& project, Scene& scene, MaterialForm form, Problems& problems)
        : project_(project), scene_(scene), form_(form), problems_(problems) {}

    /// Index of the scene material for a .mtl, or -1 after errors.
    int add(const AssetRef& material, const std::string& what);
    /// Index of the material of renderers that name none: builtin-standard as its effect has it.
    int addDefault();
    /// A material as the glTF importer of Cocos' editor makes it of metallic-roughness: builtin-standard, its macros,
    /// properties and technique. Does nothing in the plain form. Its textures are read as they are stored: the effects
    /// square colours themselves. Maps with more than the two sets of coordinates that effects have are taken away.
    void translate(SceneMaterial& material);

private:
    Value useTexture(const AssetRef& texture, bool srgb);
    void setEffect(SceneMaterial& out, const Mtl& mtl, const std::filesystem::path& effect);
    void setPlain(SceneMaterial& out, const Mtl& mtl);

    Project& project_;
    Scene& scene_;
    MaterialForm form_;
    Problems& problems_;
    std::map<std::string, int> materials_;
    std::map<std::pair<std::string, bool>, int> textures_;
    int default_ = -1;
    bool notedStandard_ = false, notedCoordinates_ = false;
};

/// For every material of a loaded glTF: translate(), and tangents for meshes whose materials have normal maps.
void translateMaterials(Scene& scene, Project& project, Problems& problems);

}  // namespace crevice::cocos
