// GLSL stages to SPIR-V by glslang, with bindings by name.
#include "effect/ShaderCompiler.h"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <glslang/build_info.h>

#include <algorithm>
#include <optional>

#include "effect/BindingResolver.h"
#include "effect/Declarations.h"
#include "effect/GlslMessages.h"
#include "effect/StageTranslator.h"

namespace crevice {
namespace {

constexpr EShMessages kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
constexpr int kGlslVersion = 450;

EShLanguage toLanguage(ShaderStageBits stage) {
    if (stage == kVertexBit) return EShLangVertex;
    return stage == kFragmentBit ? EShLangFragment : EShLangCompute;
}

/// A shader and the text it keeps pointers to.
struct ParsedStage {
    const StageSource* source = nullptr;
    std::string text;
    std::unique_ptr<glslang::TShader> shader;
};

bool parseStage(ParsedStage& stage, Problems& problems) {
    const EShLanguage language = toLanguage(stage.source->stage);
    stage.text = stage.source->head + stage.source->text;
    stage.shader = std::make_unique<glslang::TShader>(language);
    const char* text = stage.text.c_str();
    const int length = static_cast<int>(stage.text.size());
    stage.shader->setStringsWithLengths(&text, &length, 1);
    stage.shader->setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
    stage.shader->setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    // SPIR-V 1.5: from 1.6 on glslang writes LocalSizeId, which needs a feature of Vulkan 1.3.
    stage.shader->setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
    stage.shader->setAutoMapBindings(!stage.source->numbered);
    stage.shader->setAutoMapLocations(!stage.source->numbered);
    const bool ok = stage.shader->parse(GetDefaultResources(), kGlslVersion, false, kMessages);
    reportGlslMessages(stage.shader->getInfoLog(), *stage.source, problems);
    if (!ok && !problems.hasErrors()) problems.error(stage.source->flat.locate(1), "the shader does not compile");
    return ok;
}

bool numberByName(glslang::TProgram& program, std::span<const StageSource> sources, const BindingMap& bindings,
                  Problems& problems) {
    std::map<EShLanguage, Declarations> declarations;
    for (const StageSource& source : sources) declarations.emplace(toLanguage(source.stage), Declarations(source.flat));
    BindingResolver resolver(
        bindings, [&](EShLanguage stage, const std::string& name) { return declarations.at(stage).declared(name); },
        problems);
    glslang::TGlslIoMapper mapper;
    const bool mapped = program.mapIO(&resolver, &mapper);
    if (!mapped && !problems.hasErrors())
        reportLinkMessages(program.getInfoLog(), {sources.begin(), sources.end()}, problems);
    return !problems.hasErrors();
}

StageCode translate(glslang::TProgram& program, ShaderStageBits stage) {
    glslang::SpvOptions options;
    options.disableOptimizer = true;  // What is reflected must be what runs; see SPIRV-Cross' active set.
    StageCode code;
    code.stage = stage;
    glslang::GlslangToSpv(*program.getIntermediate(toLanguage(stage)), code.words, &options);
    return code;
}

bool linkTogether(std::vector<ParsedStage>& stages, std::span<const StageSource> sources, const BindingMap& bindings,
                  std::vector<StageCode>& code, Problems& problems) {
    glslang::TProgram program;
    for (const ParsedStage& stage : stages) program.addShader(stage.shader.get());
    if (!program.link(kMessages)) {
        reportLinkMessages(program.getInfoLog(), {sources.begin(), sources.end()}, problems);
        return false;
    }
    if (!numberByName(program, sources, bindings, problems)) return false;
    for (const ParsedStage& stage : stages) code.push_back(translate(program, stage.source->stage));
    return true;
}

/// Stages whose numbers are written out agree by those: what one declares otherwise than the other in parts that
/// neither uses is nobody's business.
bool linkEach(std::vector<ParsedStage>& stages, std::span<const StageSource> sources, std::vector<StageCode>& code,
              Problems& problems) {
    for (const ParsedStage& stage : stages) {
        glslang::TProgram program;
        program.addShader(stage.shader.get());
        if (!program.link(kMessages)) {
            reportLinkMessages(program.getInfoLog(), {sources.begin(), sources.end()}, problems);
            return false;
        }
        code.push_back(translate(program, stage.source->stage));
    }
    return true;
}

/// The short way; nothing where there are errors.
std::optional<std::vector<StageCode>> translateEach(std::span<const StageSource> sources, StageTranslator& translator) {
    std::vector<StageCode> code;
    for (const StageSource& source : sources) {
        auto words = translator.translate(source.stage, source.head + source.text);
        if (!words) return std::nullopt;
        code.push_back({source.stage, std::move(*words)});
    }
    return code;
}

}  // namespace

struct ShaderCompiler::Process {
    Process() { glslang::InitializeProcess(); }
    ~Process() { glslang::FinalizeProcess(); }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    StageTranslator translator;
};

ShaderCompiler::ShaderCompiler() = default;
ShaderCompiler::~ShaderCompiler() = default;

std::vector<StageCode> ShaderCompiler::compile(std::span<const StageSource> sources, const BindingMap& bindings,
                                               Problems& problems) {
    if (!process_) process_ = std::make_unique<Process>();
    const bool numbered = std::all_of(sources.begin(), sources.end(), [](const auto& s) { return s.numbered; });
    if (numbered)
        if (auto code = translateEach(sources, process_->translator)) return std::move(*code);
    Problems own;
    const auto fail = [&] {
        if (own.hasErrors()) problems.add(Error(own.all()));
        return std::vector<StageCode>{};
    };
    std::vector<ParsedStage> stages(sources.size());
    bool parsed = true;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        stages[i].source = &sources[i];
        parsed = parseStage(stages[i], own) && parsed;
    }
    if (!parsed || own.hasErrors()) return fail();

    std::vector<StageCode> code;
    const bool linked =
        numbered ? linkEach(stages, sources, code, own) : linkTogether(stages, sources, bindings, code, own);
    return linked && !own.hasErrors() ? code : fail();
}

std::string ShaderCompiler::version() {
    // The last number changes when our own numbering or options do.
    return fmt::format("glslang {}.{}.{} crevice 2", GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR,
                       GLSLANG_VERSION_PATCH);
}

}  // namespace crevice
