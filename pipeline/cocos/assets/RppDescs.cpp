// Field by field; every default is that of the engine's class.
#include "cocos/assets/RppDescs.h"

#include <algorithm>

#include <fmt/format.h>

namespace crevice::cocos {
namespace {

/// Projects derive classes from RenderQueueDesc; such objects have its fields.
bool isQueueOfScript(const Value& object, std::string_view key) {
    const Value* phases = object.find("stages");
    return key == "renderQueues" && phases && phases->isArray() && !typeOf(object).empty();
}

}  // namespace

std::vector<const Value*> RppDescReader::objects(const Value& owner, std::string_view key,
                                                 std::initializer_list<std::string_view> types) const {
    std::vector<const Value*> found;
    const Value* list = FieldReader(owner, problems_).list(key);
    for (const Value* object : graph_.resolveList(list, fmt::format("'{}'", key), problems_)) {
        const std::string written = typeOf(*object);
        if (std::find(types.begin(), types.end(), written) != types.end()) {
            found.push_back(object);
        } else if (isQueueOfScript(*object, key)) {
            problems_.note(object->where(),
                           fmt::format("'{}' is a script: it is read as a '{}'", written, *types.begin()));
            found.push_back(object);
        } else {
            problems_.error(object->where(), fmt::format("an item of '{}' is of type '{}'", key, written),
                            fmt::format("name an object of type '{}'", *types.begin()));
        }
    }
    return found;
}

std::vector<std::string> RppDescReader::words(const Value& object, std::string_view key) const {
    std::vector<std::string> words;
    const Value* list = FieldReader(object, problems_).list(key);
    if (!list) return words;
    for (const Value& item : list->items()) {
        if (item.isString()) {
            words.push_back(item.string());
        } else {
            problems_.error(item.where(), fmt::format("an item of '{}' must be a name, not {}", key, item.typeName()),
                            "write names in quotes");
        }
    }
    return words;
}

RppQueue RppDescReader::queue(const Value& object) const {
    const FieldReader fields(object, problems_);
    const std::int64_t mode = fields.integer("sortMode", 0);
    if (mode != 0 && mode != 1) {
        problems_.error(fields.find("sortMode")->where(), fmt::format("'sortMode' {} is unknown", mode),
                        "0 sorts front to back, 1 back to front");
    }
    return {.transparent = fields.boolean("isTransparent", false),
            .backToFront = mode == 1,
            .phases = words(object, "stages"),
            .where = object.where()};
}

RppRenderTexture RppDescReader::renderTexture(const Value& object) const {
    const FieldReader fields(object, problems_);
    return {.name = fields.text("name"), .texture = fields.asset("texture"), .where = object.where()};
}

RppTextureDesc RppDescReader::textureDesc(const Value& object) const {
    const FieldReader fields(object, problems_);
    return {.name = fields.text("name"),
            .type = fields.integer("type", 1),
            .usage = fields.integer("usage", 0),
            .format = fields.integer("format", 0),
            .width = fields.integer("width", -1),
            .height = fields.integer("height", -1),
            .where = object.where()};
}

RppMaterial RppDescReader::material(const Value& object) const {
    const FieldReader fields(object, problems_);
    return {.name = fields.text("name"), .material = fields.asset("material"), .where = object.where()};
}

RppAttachment RppDescReader::attachment(const Value& object) const {
    const FieldReader fields(object, problems_);
    return {.format = fields.integer("format", 0),
            .loadOp = fields.integer(fields.firstOf({"loadOp", "depthLoadOp"}), 2),
            .storeOp = fields.integer(fields.firstOf({"storeOp", "depthStoreOp"}), 0),
            .stencilLoadOp = fields.integer("stencilLoadOp", 2),
            .stencilStoreOp = fields.integer("stencilStoreOp", 0),
            .sampleCount = fields.integer("sampleCount", 1),
            .where = object.where()};
}

RppRenderPass RppDescReader::renderPass(const Value& object) const {
    const FieldReader fields(object, problems_);
    RppRenderPass pass{.index = fields.integer("index", -1), .where = object.where()};
    for (const Value* color : objects(object, "colorAttachments", {"ColorDesc"})) {
        pass.colors.push_back(attachment(*color));
    }
    if (const Value* depth = fields.find("depthStencilAttachment")) {
        if (const Value* desc = graph_.resolve(*depth, "'depthStencilAttachment'", problems_))
            pass.depthStencil.push_back(attachment(*desc));
    }
    return pass;
}

RppFrameBuffer RppDescReader::frameBuffer(const Value& object) const {
    const FieldReader fields(object, problems_);
    return {.name = fields.text("name"),
            .renderPass = fields.integer("renderPass", 0),
            .colorTextures = words(object, "colorTextures"),
            .depthStencilTexture = fields.text("depthStencilTexture"),
            .texture = fields.asset("texture"),
            .where = object.where()};
}

}  // namespace crevice::cocos
