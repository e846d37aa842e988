// What glslang::TShader and TProgram do for a single shader (MachineIndependent/ShaderLang.cpp), over kept tables.
#include "effect/StageTranslator.h"

#include <glslang/build_info.h>

#if GLSLANG_VERSION_MAJOR == 12
#include <glslang/Include/InitializeGlobals.h>
#include <glslang/MachineIndependent/Initialize.h>
#include <glslang/MachineIndependent/ParseHelper.h>
#include <glslang/MachineIndependent/Scan.h>
#include <glslang/MachineIndependent/ScanContext.h>
#include <glslang/MachineIndependent/SymbolTable.h>
#include <glslang/MachineIndependent/localintermediate.h>
#include <glslang/MachineIndependent/preprocessor/PpContext.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <array>
#include <string_view>

namespace crevice {
namespace {

using namespace glslang;

constexpr int kVersion = 450;
constexpr std::string_view kVersionLine = "#version 450\n";
constexpr EProfile kProfile = ECoreProfile;
constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

SpvVersion target() {
    SpvVersion version;
    version.spv = EShTargetSpv_1_5;
    version.vulkanGlsl = 100;
    version.vulkan = EShTargetVulkan_1_2;
    return version;
}

constexpr std::array<EShLanguage, 3> kLanguages{EShLangVertex, EShLangFragment, EShLangCompute};

std::size_t indexOf(ShaderStageBits stage) { return stage == kVertexBit ? 0 : stage == kFragmentBit ? 1 : 2; }

/// glslang counts those that use it.
struct Process {
    Process() { InitializeProcess(); }
    ~Process() { FinalizeProcess(); }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
};

/// All that glslang allocates meanwhile comes from one pool and goes with the end of this.
class PoolScope {
public:
    explicit PoolScope(TPoolAllocator& pool) : pool_(pool), previous_(&GetThreadPoolAllocator()) {
        SetThreadPoolAllocator(&pool_);
        pool_.push();
    }
    ~PoolScope() {
        pool_.pop();
        SetThreadPoolAllocator(previous_);
    }
    PoolScope(const PoolScope&) = delete;
    PoolScope& operator=(const PoolScope&) = delete;

private:
    TPoolAllocator& pool_;
    TPoolAllocator* previous_;
};

/// A parser with its parts.
struct Parser {
    Parser(TSymbolTable& symbols, TIntermediate& tree, EShLanguage language, TInfoSink& said, bool builtIns)
        : context(symbols, tree, builtIns, kVersion, kProfile, target(), language, said, builtIns,
                  builtIns ? EShMsgDefault : kMessages, &entry),
          preprocessor(context, "", includer),
          scanner(context) {
        tree.setSource(EShSourceGlsl);
        tree.setEntryPointName("main");
        context.setScanContext(&scanner);
        context.setPpContext(&preprocessor);
    }

    TString entry;
    TShader::ForbidIncluder includer;
    TParseContext context;
    TPpContext preprocessor;
    TScanContext scanner;
};

/// Declares what `text` does in a scope of its own. False when glslang does not know its own names.
bool declare(const TString& text, EShLanguage language, TSymbolTable& symbols) {
    TInfoSink said;
    TIntermediate tree(language, kVersion, kProfile);
    Parser parser(symbols, tree, language, said, true);
    symbols.push();
    if (text.empty()) return true;
    const char* start = text.c_str();
    std::size_t length = text.size();
    TInputScanner input(1, &start, &length);
    return parser.context.parseShaderStrings(parser.preprocessor, input);
}

bool isNamePart(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// A name in the text begins so, but for those that an #extension line names.
bool hasName(std::string_view text, std::string_view front) {
    constexpr std::string_view kExtension = "#extension ";
    for (std::size_t at = 0; (at = text.find(front, at)) != std::string_view::npos; at += front.size())
        if ((at == 0 || !isNamePart(text[at - 1])) && !text.substr(0, at).ends_with(kExtension)) return true;
    return false;
}

/// False where nothing in the text asks for a macro that glslang defines in front of it.
bool needsPreamble(std::string_view text) {
    return hasName(text, "GL_") || hasName(text, "VULKAN") || text.find("##") != std::string_view::npos;
}

}  // namespace

struct StageTranslator::State {
    const Process process;
    TPoolAllocator kept;     ///< What the tables are in: it outlives them.
    TPoolAllocator passing;  ///< Of one shader.
    /// The levels of glslang's own tables: of all stages, of one stage, of one with a device's limits. Read-only.
    TSymbolTable common;
    std::array<TSymbolTable, 3> ofStages;
    bool ready = false, broken = false;

    TSymbolTable* symbolsOf(ShaderStageBits stage);
    bool read();
};

/// False where glslang cannot read its own names.
bool StageTranslator::State::read() {
    const PoolScope scope(passing);
    TBuiltIns names;
    names.initialize(kVersion, kProfile, target());
    TSymbolTable all;
    std::array<TSymbolTable, 3> each;
    if (!declare(names.getCommonString(), EShLangVertex, all)) return false;
    for (std::size_t i = 0; i < each.size(); ++i) {
        const EShLanguage language = kLanguages[i];
        each[i].adoptLevels(all);
        TBuiltIns limits;
        limits.initialize(*GetDefaultResources(), kVersion, kProfile, target(), language);
        if (!declare(names.getStageString(language), language, each[i])) return false;
        names.identifyBuiltIns(kVersion, kProfile, target(), language, each[i]);
        if (!declare(limits.getCommonString(), language, each[i])) return false;
        limits.identifyBuiltIns(kVersion, kProfile, target(), language, each[i], *GetDefaultResources());
    }
    // Copies in the memory that stays; what parsing leaves around the tables goes.
    SetThreadPoolAllocator(&kept);
    common.copyTable(all);
    for (std::size_t i = 0; i < each.size(); ++i) {
        ofStages[i].adoptLevels(common);
        ofStages[i].copyTable(each[i]);
        ofStages[i].readOnly();
    }
    SetThreadPoolAllocator(&passing);
    return true;
}

TSymbolTable* StageTranslator::State::symbolsOf(ShaderStageBits stage) {
    if (!ready && !broken) (read() ? ready : broken) = true;
    return ready ? &ofStages[indexOf(stage)] : nullptr;
}

StageTranslator::StageTranslator() : state_(new State) {}

StageTranslator::~StageTranslator() = default;

std::optional<std::vector<std::uint32_t>> StageTranslator::translate(ShaderStageBits stage, const std::string& text) {
    if (!text.starts_with(kVersionLine)) return std::nullopt;
    TSymbolTable* known = state_->symbolsOf(stage);
    if (known == nullptr) return std::nullopt;
    const EShLanguage language = kLanguages[indexOf(stage)];
    const PoolScope scope(state_->passing);
    TInfoSink said;
    TIntermediate tree(language, kVersion, kProfile);
    tree.setSpv(target());
    tree.setOriginUpperLeft();
    {
        TSymbolTable symbols;
        symbols.adoptLevels(*known);
        Parser parser(symbols, tree, language, said, false);
        parser.context.setLimits(*GetDefaultResources());
        parser.context.initializeExtensionBehavior();
        std::string preamble;
        if (needsPreamble(text)) parser.context.getPreamble(preamble);
        // As TShader has it: what stands in front of the shader, the shader, and something, lest it be empty. The
        // scanner wants no empty string at the front.
        constexpr std::string_view kLast = "\n int;";
        std::array<const char*, 3> starts{preamble.c_str(), text.c_str(), kLast.data()};
        std::array<std::size_t, 3> lengths{preamble.size(), text.size(), kLast.size()};
        const int first = preamble.empty() ? 1 : 0;
        TInputScanner input(3 - first, starts.data() + first, lengths.data() + first, nullptr, 1 - first, 1);
        symbols.push();
        if (!parser.context.parseShaderStrings(parser.preprocessor, input)) return std::nullopt;
        if (tree.getTreeRoot() == nullptr || !tree.postProcess(tree.getTreeRoot(), language)) return std::nullopt;
    }
    TInfoSink linking;  // whose remarks nobody reads
    tree.finalCheck(linking, false);
    if (tree.getNumErrors() > 0 || std::string_view(said.info.c_str()).find("ERROR") != std::string_view::npos)
        return std::nullopt;
    SpvOptions options;
    options.disableOptimizer = true;  // as ShaderCompiler has it
    std::vector<std::uint32_t> words;
    GlslangToSpv(tree, words, &options);
    return words;
}

}  // namespace crevice

#else

namespace crevice {

struct StageTranslator::State {};
StageTranslator::StageTranslator() = default;
StageTranslator::~StageTranslator() = default;
std::optional<std::vector<std::uint32_t>> StageTranslator::translate(ShaderStageBits, const std::string&) {
    return std::nullopt;
}

}  // namespace crevice
#endif
