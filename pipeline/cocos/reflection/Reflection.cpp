// A shader's metadata from its declarations: merged over the stages by name, in the order of their first appearance.
#include "cocos/reflection/Reflection.h"

#include <algorithm>

#include "cocos/CocosEffects.h"
#include "cocos/interface/BlockRules.h"
#include "cocos/interface/GlslTypes.h"
#include "cocos/interface/Numbering.h"

namespace crevice::cocos {
namespace {

Value number(std::int64_t value) { return Value::makeInteger(value); }
Value text(const std::string& value) { return Value::makeString(value); }

void append(Value& array, Value item) { array.items().push_back(std::move(item)); }

int typeOf(const std::string& name) {
    const GlslType* type = findGlslType(name);
    return type == nullptr ? 0 : type->type;
}

/// A resource with all stages that declare it.
struct Resource {
    const InterfaceDeclaration* first = nullptr;
    const StageText* text = nullptr;
    std::uint32_t stages = 0;
};

class ShaderReflection {
public:
    ShaderReflection(const std::vector<StageText>& stages, Problems& problems) : stages_(stages) {
        for (const StageText& stage : stages) interfaces_.push_back(readInterface(stage, problems));
        numbers_ = numberInterfaces(interfaces_, problems);
        for (StageMacro& macro : joinMacros(stages))
            if (!macro.constant) macros_.push_back(std::move(macro));
    }

    Value run(const std::string& name) const {
        Value shader = Value::makeObject();
        shader.set("name", text(name));
        Value builtins = Value::makeObject();
        builtins.set("statistics", statistics());
        builtins.set("globals", builtin(Builtin::Global));
        builtins.set("locals", builtin(Builtin::Local));
        shader.set("builtins", std::move(builtins));
        shader.set("defines", defines());
        shader.set("attributes", attributes());
        shader.set("blocks", material(InterfaceKind::Block));
        shader.set("samplerTextures", material(InterfaceKind::CombinedSampler));
        shader.set("samplers", material(InterfaceKind::Sampler));
        shader.set("textures", material(InterfaceKind::Texture));
        shader.set("buffers", material(InterfaceKind::Buffer));
        shader.set("images", material(InterfaceKind::Image));
        shader.set("subpassInputs", material(InterfaceKind::SubpassInput));
        return shader;
    }

private:
    /// Cocos knows its own by their names; without a pragma in front of it such a one is global.
    static Builtin sideOf(const InterfaceDeclaration& declaration) {
        return declaration.builtin == Builtin::None && isEngineName(declaration.name) ? Builtin::Global
                                                                                      : declaration.builtin;
    }

    std::vector<Resource> resources(InterfaceKind kind, Builtin builtin) const {
        std::vector<Resource> found;
        std::map<std::string_view, std::size_t> byName;
        for (std::size_t i = 0; i < interfaces_.size(); ++i) {
            for (const InterfaceDeclaration& declaration : interfaces_[i].declarations) {
                if (declaration.kind != kind || sideOf(declaration) != builtin) continue;
                const auto [it, isNew] = byName.emplace(declaration.name, found.size());
                if (isNew) found.push_back({&declaration, &stages_[i], 0});
                found[it->second].stages |= interfaces_[i].stage;
            }
        }
        return found;
    }

    static Value conditions(const StageText& stage, const InterfaceDeclaration& declaration) {
        Value list = Value::makeArray();
        if (declaration.conditions < stage.conditions.size())
            for (const std::string& condition : stage.conditions[declaration.conditions]) append(list, text(condition));
        return list;
    }

    /// The same without macros that no material sets.
    Value materialConditions(const StageText& stage, const InterfaceDeclaration& declaration) const {
        Value all = conditions(stage, declaration), list = Value::makeArray();
        for (Value& condition : all.items()) {
            const std::string& need = condition.string();
            const std::string_view name = std::string_view(need).substr(need.starts_with('!') ? 1 : 0);
            const bool listed = std::any_of(macros_.begin(), macros_.end(),
                                            [&](const StageMacro& macro) { return macro.info.name == name; });
            if (listed) append(list, std::move(condition));
        }
        return list;
    }

    Value builtin(Builtin which) const {
        Value all = Value::makeObject();
        const auto add = [&](const char* key, InterfaceKind kind) {
            Value list = Value::makeArray();
            for (const Resource& resource : resources(kind, which)) {
                Value item = Value::makeObject();
                item.set("name", text(resource.first->name));
                item.set("defines", conditions(*resource.text, *resource.first));
                append(list, std::move(item));
            }
            all.set(key, std::move(list));
        };
        add("blocks", InterfaceKind::Block);
        add("samplerTextures", InterfaceKind::CombinedSampler);
        add("buffers", InterfaceKind::Buffer);
        add("images", InterfaceKind::Image);
        return all;
    }

    int bindingOf(const InterfaceDeclaration& declaration) const { return numbers_.slots.at(declaration.name).binding; }

    /// A sampler for devices without subpass inputs has the input's number, and the input speaks for both.
    bool standsInForSubpassInput(const InterfaceDeclaration& sampler) const {
        const auto inputs = resources(InterfaceKind::SubpassInput, Builtin::None);
        return std::any_of(inputs.begin(), inputs.end(),
                           [&](const Resource& input) { return bindingOf(*input.first) == bindingOf(sampler); });
    }

    Value material(InterfaceKind kind) const {
        Value list = Value::makeArray();
        for (const Resource& resource : resources(kind, Builtin::None)) {
            const InterfaceDeclaration& declaration = *resource.first;
            if (kind == InterfaceKind::CombinedSampler && standsInForSubpassInput(declaration)) continue;
            const bool typed = kind == InterfaceKind::CombinedSampler || kind == InterfaceKind::Texture ||
                               kind == InterfaceKind::Image;
            Value item = Value::makeObject();
            item.set("name", text(declaration.name));
            if (typed) item.set("type", number(typeOf(declaration.type)));
            if (kind != InterfaceKind::Block && kind != InterfaceKind::Buffer)
                item.set("count", number(declaration.size.count));
            if (kind == InterfaceKind::Buffer || kind == InterfaceKind::Image)
                item.set("memoryAccess", number(declaration.readOnly ? 1 : declaration.writeOnly ? 2 : 3));
            item.set("defines", materialConditions(*resource.text, declaration));
            item.set("stageFlags", number(resource.stages));
            item.set("binding", number(bindingOf(declaration)));
            if (kind == InterfaceKind::Block) item.set("members", members(declaration));
            append(list, std::move(item));
        }
        return list;
    }

    static Value members(const InterfaceDeclaration& block) {
        Value list = Value::makeArray();
        for (const InterfaceMember& member : block.members) {
            Value item = Value::makeObject();
            item.set("name", text(member.name));
            item.set("type", number(typeOf(member.type)));
            item.set("count", number(member.size.count));
            append(list, std::move(item));
        }
        return list;
    }

    std::int64_t vectorsOf(ShaderStageBits stage) const {
        std::int64_t sum = 0;
        for (const StageInterface& interface : interfaces_)
            if (interface.stage == stage) sum += uniformVectors(interface);
        return sum;
    }

    Value statistics() const {
        Value all = Value::makeObject();
        const auto has = [&](ShaderStageBits bit) {
            return std::any_of(stages_.begin(), stages_.end(), [&](const auto& s) { return s.stage == bit; });
        };
        if (has(kComputeBit)) {
            all.set("CC_EFFECT_USED_COMPUTE_UNIFORM_VECTORS", number(vectorsOf(kComputeBit)));
        } else {
            all.set("CC_EFFECT_USED_VERTEX_UNIFORM_VECTORS", number(vectorsOf(kVertexBit)));
            all.set("CC_EFFECT_USED_FRAGMENT_UNIFORM_VECTORS", number(vectorsOf(kFragmentBit)));
        }
        return all;
    }

    Value defines() const {
        Value list = Value::makeArray();
        for (const StageMacro& macro : macros_) append(list, define(macro));
        return list;
    }

    static Value define(const StageMacro& macro) {
        const DefineInfo& info = macro.info;
        Value item = Value::makeObject();
        item.set("name", text(info.name));
        if (info.type == DefineType::String) {
            item.set("type", text("string"));
            Value options = Value::makeArray();
            for (const std::string& option : info.options) append(options, text(option));
            item.set("options", std::move(options));
        } else if (info.type == DefineType::Number) {
            item.set("type", text("number"));
            if (info.range) {
                Value range = Value::makeArray();
                append(range, number(info.range->first));
                append(range, number(info.range->second));
                item.set("range", std::move(range));
            }
        } else {
            item.set("type", text("boolean"));
        }
        if (macro.hasDefault) item.set("default", defaultOf(info));
        return item;
    }

    static Value defaultOf(const DefineInfo& info) {
        if (info.type == DefineType::String) return text(info.defaultValue);
        const bool isNumber = !info.defaultValue.empty() && info.defaultValue.size() < 10 &&
                              info.defaultValue.find_first_not_of("0123456789") == std::string::npos;
        return isNumber ? number(std::stoll(info.defaultValue)) : text(info.defaultValue);
    }

    Value attributes() const {
        Value list = Value::makeArray();
        for (std::size_t i = 0; i < interfaces_.size(); ++i) {
            if (interfaces_[i].stage != kVertexBit) continue;
            std::map<std::string_view, bool> seen;
            for (const InterfaceDeclaration& declaration : interfaces_[i].declarations)
                if (declaration.kind == InterfaceKind::Input && seen.emplace(declaration.name, true).second)
                    append(list, attribute(stages_[i], declaration));
        }
        return list;
    }

    Value attribute(const StageText& stage, const InterfaceDeclaration& declaration) const {
        Value item = Value::makeObject();
        item.set("name", text(declaration.name));
        Value enclosing = materialConditions(stage, declaration);
        const bool instanced = std::any_of(enclosing.items().begin(), enclosing.items().end(),
                                           [](const Value& v) { return v.string() == "USE_INSTANCING"; });
        item.set("defines", std::move(enclosing));
        const GlslType* type = findGlslType(declaration.type);
        const NamedFormat named = findFormat(declaration.formatMark);
        const int format = named.format != 0 ? named.format : type != nullptr ? type->attributeFormat : 0;
        if (format != 0) item.set("format", number(format));
        if (named.normalized) item.set("isNormalized", Value::makeBool(true));
        if (instanced) item.set("isInstanced", Value::makeBool(true));
        if (const auto it = numbers_.attributes.find(declaration.name); it != numbers_.attributes.end())
            item.set("location", number(it->second));
        return item;
    }

    const std::vector<StageText>& stages_;
    std::vector<StageInterface> interfaces_;
    Numbers numbers_;
    std::vector<StageMacro> macros_;  ///< Those that a material may set.
};

}  // namespace

Value reflectShader(const std::string& name, const std::vector<StageText>& stages, Problems& problems) {
    return ShaderReflection(stages, problems).run(name);
}

UniformTypes uniformTypesOf(const Value& shader) {
    UniformTypes types;
    const auto type = [](const Value& item) { return static_cast<int>(item.find("type")->integer()); };
    for (const Value& block : shader.find("blocks")->items())
        for (const Value& member : block.find("members")->items())
            types.emplace(member.find("name")->string(), type(member));
    for (const Value& sampler : shader.find("samplerTextures")->items())
        types.emplace(sampler.find("name")->string(), type(sampler));
    return types;
}

}  // namespace crevice::cocos
