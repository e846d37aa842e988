// What a stage's SPIR-V declares and statically uses, by SPIRV-Cross, as Crevice's plain facts.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <spirv_cross/spirv_cross.hpp>

#include "effect/Declarations.h"
#include "effect/StageFacts.h"

namespace crevice {
namespace {

namespace sc = spirv_cross;

std::string typeName(const sc::SPIRType& type) {
    using Base = sc::SPIRType::BaseType;
    const char* scalar = nullptr;
    const char* prefix = "";
    switch (type.basetype) {
        case Base::Float:
            scalar = "float";
            break;
        case Base::Int:
            scalar = "int", prefix = "i";
            break;
        case Base::UInt:
            scalar = "uint", prefix = "u";
            break;
        case Base::Boolean:
            scalar = "bool", prefix = "b";
            break;
        case Base::Double:
            scalar = "double", prefix = "d";
            break;
        case Base::Struct:
            return "struct";
        default:
            return "other";
    }
    if (type.columns > 1 && type.columns == type.vecsize) return fmt::format("{}mat{}", prefix, type.columns);
    if (type.columns > 1) return fmt::format("{}mat{}x{}", prefix, type.columns, type.vecsize);
    return type.vecsize > 1 ? fmt::format("{}vec{}", prefix, type.vecsize) : scalar;
}

/// How an image without `readonly` or `writeonly` is really used: an opcode scan through loads of its variable.
struct ImageUse {
    std::set<std::uint32_t> read, written;
};

ImageUse scanImages(const std::vector<std::uint32_t>& words) {
    ImageUse use;
    std::map<std::uint32_t, std::uint32_t> variableOf;  // pointers and loaded images → variable
    const auto root = [&](std::uint32_t id) {
        const auto it = variableOf.find(id);
        return it == variableOf.end() ? id : it->second;
    };
    for (std::size_t at = 5; at < words.size();) {
        const auto op = static_cast<spv::Op>(words[at] & 0xffffu);
        const std::size_t count = words[at] >> 16;
        if (count == 0 || at + count > words.size()) break;
        const auto word = [&](std::size_t i) { return i < count ? words[at + i] : 0u; };
        if (op == spv::OpLoad || op == spv::OpAccessChain || op == spv::OpCopyObject) {
            variableOf[word(2)] = root(word(3));
        } else if (op == spv::OpImageRead || op == spv::OpImageSparseRead) {
            use.read.insert(root(word(3)));
        } else if (op == spv::OpImageWrite) {
            use.written.insert(root(word(1)));
        } else if (op == spv::OpImageTexelPointer) {  // atomics
            use.read.insert(root(word(3)));
            use.written.insert(root(word(3)));
        } else if (op == spv::OpFunctionCall) {  // may do both in there
            for (std::size_t i = 4; i < count; ++i) {
                use.read.insert(root(word(i)));
                use.written.insert(root(word(i)));
            }
        }
        at += count;
    }
    return use;
}

class StageReflection {
public:
    StageReflection(const StageCode& code, const StageSource& source, StageFacts& facts)
        : code_(code), names_(source.flat), compiler_(code.words), facts_(facts), info_(facts.info) {}

    void run() {
        active_ = compiler_.get_active_interface_variables();
        const sc::ShaderResources all = compiler_.get_shader_resources();
        images_ = all.storage_images.empty() ? ImageUse{} : scanImages(code_.words);
        for (const auto& r : all.uniform_buffers) addBlock(r, ResourceKind::UniformBlock);
        for (const auto& r : all.storage_buffers) addBlock(r, ResourceKind::StorageBuffer);
        for (const auto& r : all.sampled_images) addSampler(r);
        for (const auto& r : all.storage_images) addImage(r);
        for (const auto& r : all.separate_images)
            refuse(r, "a texture without its sampler", "declare a combined sampler2D");
        for (const auto& r : all.separate_samplers)
            refuse(r, "a sampler without its texture", "declare a combined sampler2D");
        for (const auto& r : all.subpass_inputs) refuse(r, "a subpass input", "declare a sampler2D");
        for (const auto& r : all.push_constant_buffers) refuse(r, "a push constant block", "declare a uniform block");
        if (code_.stage == kVertexBit) addVariables(all.stage_inputs, info_.inputs);
        if (code_.stage == kFragmentBit) addVariables(all.stage_outputs, info_.outputs);
        if (code_.stage != kComputeBit) addVaryings(code_.stage == kVertexBit ? all.stage_outputs : all.stage_inputs);
        if (code_.stage == kComputeBit)
            for (std::uint32_t i = 0; i < 3; ++i)
                info_.localSize[i] =
                    std::max(1u, compiler_.get_execution_mode_argument(spv::ExecutionModeLocalSize, i));
    }

private:
    ShaderResource& merge(const std::string& name, ResourceKind kind, const sc::Resource& r) {
        auto it =
            std::find_if(info_.resources.begin(), info_.resources.end(), [&](const auto& x) { return x.name == name; });
        const bool isNew = it == info_.resources.end();
        ShaderResource& resource = isNew ? info_.resources.emplace_back() : *it;
        resource.name = name;
        resource.kind = kind;
        resource.slot = {compiler_.get_decoration(r.id, spv::DecorationDescriptorSet),
                         compiler_.get_decoration(r.id, spv::DecorationBinding)};
        const sc::SPIRType& type = compiler_.get_type(r.type_id);
        for (const std::uint32_t size : type.array) resource.count *= isNew ? size : 1;
        resource.stages |= code_.stage;
        const bool isActive = active_.contains(r.id);
        if (resource.where.line == 0) resource.where = names_.declared(name);
        if (isActive && resource.firstUse.line == 0) {
            std::vector<std::string> members;
            const sc::SPIRType& base = compiler_.get_type(r.base_type_id);
            for (std::uint32_t i = 0; i < base.member_types.size(); ++i)
                members.push_back(compiler_.get_member_name(base.self, i));
            resource.firstUse = names_.firstUse(name, members);
        }
        resource.active = resource.active || isActive;
        return resource;
    }

    void addBlock(const sc::Resource& r, ResourceKind kind) {
        ShaderResource& block = merge(compiler_.get_name(r.base_type_id), kind, r);
        const sc::SPIRType& type = compiler_.get_type(r.base_type_id);
        block.size = static_cast<std::uint32_t>(compiler_.get_declared_struct_size(type));
        block.members.clear();
        for (std::uint32_t i = 0; i < type.member_types.size(); ++i) {
            const sc::SPIRType& member = compiler_.get_type(type.member_types[i]);
            BlockMember& out = block.members.emplace_back();
            out.name = compiler_.get_member_name(type.self, i);
            out.offset = compiler_.type_struct_member_offset(type, i);
            out.size = static_cast<std::uint32_t>(compiler_.get_declared_struct_member_size(type, i));
            out.type = typeName(member);
            if (member.array.empty()) continue;
            out.arrayStride = compiler_.type_struct_member_array_stride(type, i);
            if (isPlainArray(member, kind))
                out.arrayCount = member.array.back();
            else
                facts_.mistakes.push_back(
                    {static_cast<std::size_t>(&block - info_.resources.data()),
                     {Severity::Error,
                      block.where,
                      fmt::format("member '{}' of '{}' is an array that Crevice cannot fill", out.name, block.name),
                      "give it one dimension, with a size that is no specialization constant",
                      {}}});
        }
        if (kind == ResourceKind::StorageBuffer) {
            const sc::Bitset flags = compiler_.get_buffer_block_flags(r.id);
            block.readOnly = flags.get(spv::DecorationNonWritable);
            block.writeOnly = flags.get(spv::DecorationNonReadable);
        } else {
            block.readOnly = true;
        }
    }

    /// A size may be the id of a constant that is chosen later; materials write uniform blocks one element at a time.
    static bool isPlainArray(const sc::SPIRType& member, ResourceKind kind) {
        const auto& literal = member.array_size_literal;
        return std::all_of(literal.begin(), literal.end(), [](bool one) { return one; }) &&
               (member.array.size() == 1 || kind != ResourceKind::UniformBlock);
    }

    void addSampler(const sc::Resource& r) {
        if (compiler_.get_type(r.type_id).image.dim == spv::DimBuffer)
            return refuse(r, "a texel buffer", "declare a readonly storage buffer, or a sampler2D");
        ShaderResource& sampler = merge(compiler_.get_name(r.id), ResourceKind::CombinedSampler, r);
        sampler.readOnly = true;
        sampler.cube = compiler_.get_type(r.type_id).image.dim == spv::DimCube;
    }

    void addImage(const sc::Resource& r) {
        ShaderResource& image = merge(compiler_.get_name(r.id), ResourceKind::StorageImage, r);
        const bool read = images_.read.contains(r.id), written = images_.written.contains(r.id);
        image.readOnly = compiler_.has_decoration(r.id, spv::DecorationNonWritable) || (read && !written);
        image.writeOnly = compiler_.has_decoration(r.id, spv::DecorationNonReadable) || (written && !read);
    }

    void refuse(const sc::Resource& r, const char* what, const char* help) {
        std::string name = compiler_.get_name(r.id);
        if (names_.declared(name).line == 0) name = compiler_.get_name(r.base_type_id);
        Problem problem{Severity::Error,
                        names_.declared(name),
                        fmt::format("'{}' is {}, which Crevice does not bind", name, what),
                        help,
                        {}};
        if (!facts_.numbered)
            facts_.mistakes.push_back({std::nullopt, std::move(problem)});
        else if (active_.contains(r.id))
            info_.refusals.push_back(std::move(problem));
    }

    template <class Resources>
    void addVariables(const Resources& resources, std::vector<ShaderVariable>& out) {
        for (const auto& r : resources)
            out.push_back({compiler_.get_name(r.id), compiler_.get_decoration(r.id, spv::DecorationLocation),
                           typeName(compiler_.get_type(r.base_type_id)), active_.contains(r.id)});
        std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.location < b.location; });
    }

    template <class Resources>
    void addVaryings(const Resources& resources) {
        for (const auto& r : resources) {
            const sc::SPIRType& type = compiler_.get_type(r.type_id);
            StageVarying varying{compiler_.get_name(r.id), typeName(compiler_.get_type(r.base_type_id)),
                                 active_.contains(r.id), names_.declared(compiler_.get_name(r.id))};
            for (const std::uint32_t size : type.array) varying.type += fmt::format("[{}]", size);
            facts_.varyings.push_back(std::move(varying));
        }
    }

    const StageCode& code_;
    Declarations names_;
    sc::Compiler compiler_;
    StageFacts& facts_;
    ShaderInfo& info_;  ///< Of the facts.
    std::unordered_set<sc::VariableID> active_;
    ImageUse images_;
};

}  // namespace

StageFacts reflectStage(const StageCode& code, const StageSource& source) {
    StageFacts facts;
    facts.stage = code.stage;
    facts.numbered = source.numbered;
    StageReflection(code, source, facts).run();
    return facts;
}

}  // namespace crevice
