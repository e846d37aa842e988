// One step only: what is named is a picture's file, not another texture.
#include "cocos/assets/TexturePicture.h"

namespace crevice::cocos {
namespace {

const MetaAsset* atDatabaseUri(std::string_view uri, const Project& project) {
    const auto below = [&](std::string_view start, const std::filesystem::path& folder) -> const MetaAsset* {
        if (!uri.starts_with(start) || folder.empty()) return nullptr;
        return project.metas().findFile(folder / std::filesystem::path(uri.substr(start.size())));
    };
    if (const MetaAsset* asset = below("db://assets/", project.roots().projectAssets())) return asset;
    return below("db://internal/", project.roots().engineAssets());
}

}  // namespace

const MetaAsset& pictureOf(const MetaAsset& texture, const Project& project) {
    const Value* named = texture.userData.isObject() ? texture.userData.find("imageUuidOrDatabaseUri") : nullptr;
    if (!named || !named->isString()) return texture;
    const std::string& text = named->string();
    const MetaAsset* asset =
        text.starts_with("db://") ? atDatabaseUri(text, project) : project.metas().findNearest(text);
    return asset ? *asset : texture;
}

}  // namespace crevice::cocos
