// The header as written gives the keys of techniques and passes; flattened programs give the shaders.
#include "cocos/reflection/EffectReflection.h"

#include <algorithm>

#include "cocos/files/TakeOver.h"
#include "core/Files.h"

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxEffectBytes = 16u << 20;

/// The YAML between `CCEffect %{` and the first `}%`. The file was parsed before: this cannot fail.
Value readHeader(const std::string& path) {
    std::string text = readText(path, kMaxEffectBytes);
    std::size_t begin = text.find("CCEffect");
    while (begin != std::string::npos) {
        const std::size_t brace = text.find_first_not_of(" \t\r\n", begin + 8);
        if (brace != std::string::npos && text.compare(brace, 2, "%{") == 0) {
            begin = brace + 2;
            break;
        }
        begin = text.find("CCEffect", begin + 8);
    }
    if (begin == std::string::npos) return Value::makeObject();
    std::string header = text.substr(begin, text.find("}%", begin) - begin);
    std::replace(header.begin(), header.end(), '\t', ' ');
    const auto firstLine = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n') + 1;
    return parseYaml(header, path, static_cast<int>(firstLine));
}

const Value* itemAt(const Value* object, const char* key, std::size_t index) {
    const Value* list = object != nullptr && object->isObject() ? object->find(key) : nullptr;
    if (list == nullptr || !list->isArray() || index >= list->items().size()) return nullptr;
    return &list->items()[index];
}

class EffectReflection {
public:
    EffectReflection(CocosEffects& effects, const EffectAsset& effect, Problems& problems)
        : effects_(effects), effect_(effect), problems_(problems), header_(readHeader(effect.path)) {}

    Value run() {
        Value techniques = Value::makeArray();
        for (std::size_t t = 0; t < effect_.techniques.size(); ++t) techniques.items().push_back(technique(t));
        Value out = Value::makeObject();
        out.set("name", Value::makeString(effect_.name));
        out.set("techniques", std::move(techniques));
        out.set("shaders", std::move(shaders_));
        return out;
    }

private:
    Value technique(std::size_t index) {
        const EffectTechnique& technique = effect_.techniques[index];
        const Value* written = itemAt(&header_, "techniques", index);
        Value passes = Value::makeArray();
        for (std::size_t p = 0; p < technique.passes.size(); ++p) {
            const EffectPass& pass = technique.passes[p];
            const std::string name = shaderName(effect_, pass);
            const Value* shader = shaderOf(name, pass);
            const UniformTypes uniforms = shader != nullptr ? uniformTypesOf(*shader) : UniformTypes{};
            const Value* keys = itemAt(written, "passes", p);
            passes.items().push_back(reflectPass(keys != nullptr && keys->isObject() ? *keys : Value::makeObject(),
                                                 name, pass.priority, uniforms));
        }
        Value out = Value::makeObject();
        if (!technique.name.empty()) out.set("name", Value::makeString(technique.name));
        out.set("passes", std::move(passes));
        return out;
    }

    const Value* shaderOf(const std::string& name, const EffectPass& pass) {
        for (const Value& shader : shaders_.items())
            if (shader.find("name")->string() == name) return &shader;
        Problems own;
        const std::vector<StageText> stages = effects_.flatten(effect_, pass, own);
        if (!own.hasErrors() && !stages.empty()) shaders_.items().push_back(reflectShader(name, stages, own));
        if (own.hasErrors()) takeOver(own, problems_);
        return own.hasErrors() || stages.empty() ? nullptr : &shaders_.items().back();
    }

    CocosEffects& effects_;
    const EffectAsset& effect_;
    Problems& problems_;
    Value header_;
    Value shaders_ = Value::makeArray();
};

}  // namespace

std::string shaderName(const EffectAsset& effect, const EffectPass& pass) {
    if (!pass.compute.empty()) return effect.name + "|" + pass.compute;
    return effect.name + "|" + pass.vertex + "|" + pass.fragment;
}

Value reflectEffect(CocosEffects& effects, const EffectAsset& effect, Problems& problems) {
    return EffectReflection(effects, effect, problems).run();
}

}  // namespace crevice::cocos
