// Stages in a shared library: the one macro a plugin writes, and the loader that checks before it calls.
#pragma once

#include <filesystem>

namespace crevice {

class StageRegistry;

/// Grows when a class that stages use changes its layout or meaning.
inline constexpr int kPluginAbi = 1;

/// Exported by every plugin as `crevice_plugin_info`; plain C, so that any mismatch can be read safely.
struct PluginInfo {
    int abi;
    const char* compiler;   ///< "gcc 12.2.0"
    const char* buildType;  ///< "release" or "debug" (NDEBUG)
};

#if defined(__clang__)
#define CREVICE_COMPILER_ID "clang " __clang_version__
#else
#define CREVICE_COMPILER_ID "gcc " __VERSION__
#endif
#ifdef NDEBUG
#define CREVICE_BUILD_TYPE "release"
#else
#define CREVICE_BUILD_TYPE "debug"
#endif

/// CREVICE_PLUGIN(registry) { registry.add<MyStage>("MyStage", {.priority = 17, .help = "…"}); }
#define CREVICE_PLUGIN(registry)                                                                                    \
    extern "C" __attribute__((visibility("default"))) const crevice::PluginInfo crevice_plugin_info;                \
    const crevice::PluginInfo crevice_plugin_info = {crevice::kPluginAbi, CREVICE_COMPILER_ID, CREVICE_BUILD_TYPE}; \
    extern "C" __attribute__((visibility("default"))) void crevice_register_stages(crevice::StageRegistry& registry)

/// A loaded library; must outlive the registry entries and stages made from it.
class Plugin {
public:
    /// Opens, compares ABI, compiler and build type, then registers. Throws Error saying in words what differs.
    Plugin(const std::filesystem::path& path, StageRegistry& registry);
    ~Plugin();
    Plugin(Plugin&& other) noexcept;
    Plugin& operator=(Plugin&&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    void* handle_ = nullptr;
    std::filesystem::path path_;
};

}  // namespace crevice
