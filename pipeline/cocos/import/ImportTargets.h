// Internal to the importer: the images that a translated pipeline has.
#pragma once

#include <string>

#include "cocos/assets/Project.h"
#include "cocos/assets/Rpp.h"

namespace crevice::cocos {

/// "targets" of a document, in order.
class ImportTargets {
public:
    /// Depth and final colour, and of a deferred pipeline the G-buffer and the lit picture, as a profile's stages
    /// expect them.
    ImportTargets(bool v33, bool deferred);

    bool has(const std::string& name) const { return list_.find(name) != nullptr; }
    /// An image of the frame's size; nothing when the name is taken.
    void add(const std::string& name, const std::string& format, const std::string& help);
    /// The occlusion map of the article and the demo.
    void addOcclusion(const std::string& name, bool v33);
    /// A map of a light's, and the depth buffer that belongs to it.
    void addShadowMap(const std::string& name, const std::string& depth);
    /// renderTextures and textures of the pipeline: sizes from the .rt file where it exists.
    void addOf(const RppPipeline& pipeline, Project& project, Problems& problems);
    Value take() { return std::move(list_); }

private:
    void addGbuffer(bool v33);
    void addSized(const std::string& name, const std::string& format, double width, double height,
                  const std::string& help);

    Value list_ = Value::makeObject();
};

/// Our name for a number of the engine's Format enum (3.4 and later), "" for those we do not have.
std::string formatName(std::int64_t gfxFormat);

}  // namespace crevice::cocos
