// Internal to the .rpp reader: the small descriptions that pipelines of several versions carry.
#pragma once

#include "cocos/assets/Rpp.h"

namespace crevice::cocos {

/// Reads descriptions from one graph. An object of another type than asked for is an error.
class RppDescReader {
public:
    RppDescReader(const ObjectGraph& graph, Problems& problems) : graph_(graph), problems_(problems) {}

    RppQueue queue(const Value& object) const;
    RppRenderTexture renderTexture(const Value& object) const;
    RppTextureDesc textureDesc(const Value& object) const;
    RppMaterial material(const Value& object) const;
    RppRenderPass renderPass(const Value& object) const;
    RppFrameBuffer frameBuffer(const Value& object) const;
    /// All objects of a list that are of one of `types`; "" and null items are left out (templates write `""`).
    std::vector<const Value*> objects(const Value& owner, std::string_view key,
                                      std::initializer_list<std::string_view> types) const;

private:
    RppAttachment attachment(const Value& object) const;
    std::vector<std::string> words(const Value& object, std::string_view key) const;

    const ObjectGraph& graph_;
    Problems& problems_;
};

}  // namespace crevice::cocos
