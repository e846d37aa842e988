// Values for the properties of a compiled pass: fills the uniform blocks of set 1 and names the textures of its
// samplers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/Document.h"
#include "effect/EffectLibrary.h"

namespace crevice {

/// Bytes of one uniform block of set 1, laid out as the shader has it.
struct MaterialBlock {
    std::string name;
    BindingSlot slot;
    std::vector<std::byte> bytes;
};

/// One sampler of set 1.
struct MaterialSampler {
    std::string name;  ///< In the shader.
    BindingSlot slot;
    bool cube = false;
    std::string texture;      ///< white, black, grey, normal; or a file or scene texture.
    bool isProperty = false;  ///< False: no property feeds it; whoever wires targets by name may.
    Value sampler;            ///< The property's filter and address modes; null = none given.
    SourceLoc where;          ///< Of the value.
};

/// Starts with the properties' defaults. Values are checked for type, count and editor.range; those of properties that
/// the compiled variant does not use (a macro is off) are checked and otherwise without effect. The variant must
/// outlive it.
class Material {
public:
    /// What becomes of values whose property is `linear`: converted from sRGB, or taken as they are by a caller that
    /// converts them itself. The latter is how Cocos' materials are written: there matrices that nothing sets are
    /// identities, arrays take the values of their elements one after the other (a default is every element's), and
    /// what a uniform has no room for is cut off.
    enum class LinearRule { FromSrgb, AsGiven };

    /// Throws Error when a default does not fit its uniform.
    explicit Material(const EffectVariant& variant, LinearRule linear = LinearRule::FromSrgb);

    /// The "material" object of a stage: name → number, list of numbers, texture name or "auto". Collects problems.
    void apply(const Value& object, Problems& problems);

    /// Values from code. Throw Error.
    void set(std::string_view name, float value);
    void set(std::string_view name, std::int32_t value);
    void set(std::string_view name, const glm::vec2& value);
    void set(std::string_view name, const glm::vec3& value);
    void set(std::string_view name, const glm::vec4& value);
    void set(std::string_view name, const std::string& texture);
    void set(std::string_view name, const char* texture) { set(name, std::string(texture)); }

    const std::vector<MaterialBlock>& blocks() const { return blocks_; }
    const std::vector<MaterialSampler>& samplers() const { return samplers_; }
    const std::vector<EffectProperty>& properties() const { return pass_.properties; }
    /// Properties whose present value is the keyword `auto`: the runtime supplies a number before it draws.
    std::vector<std::string> autoProperties() const;
    /// The present value of a property as written, or null.
    const Value* value(std::string_view name) const;

private:
    struct Place {
        std::size_t block = 0;
        std::size_t offset = 0;  ///< Bytes.
        std::size_t stride = 0;  ///< Bytes from one element of an array to the next.
        std::uint32_t components = 0, elements = 1;
        bool integer = false;
    };
    void setIdentities();
    void setValue(const EffectProperty& property, const Value& value, Problems& problems, bool isDefault = false);
    void writeNumbers(const EffectProperty& property, const Value& value, const Place& place, bool isDefault);
    void setTexture(const EffectProperty& property, MaterialSampler& sampler, const Value& value, Problems& problems);
    bool checkNumbers(const EffectProperty& property, const Value& value, Problems& problems) const;
    bool findPlace(const EffectProperty& property, Place& place, Problems& problems) const;
    void setFromCode(std::string_view name, Value value);
    const EffectProperty* findProperty(std::string_view name) const;
    std::vector<std::string> propertyNames() const;
    MaterialSampler* findSampler(std::string_view name);

    const EffectVariant& variant_;
    const EffectPass& pass_;
    LinearRule linear_;
    std::vector<MaterialBlock> blocks_;
    std::vector<MaterialSampler> samplers_;
    std::map<std::string, Value, std::less<>> values_;
};

}  // namespace crevice
