// Opens a plugin and compares before calling: a mismatch is refused in words instead of crashing later.
#include "flow/Plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "core/Error.h"
#include "flow/StageRegistry.h"

namespace crevice {
namespace {

void checkInfo(const PluginInfo& info, const std::string& file) {
    if (info.abi != kPluginAbi) {
        throw Error(
            fmt::format("plugin '{}' was built for plugin ABI {}, this program has ABI {}", file, info.abi, kPluginAbi),
            "rebuild the plugin against this installation's headers");
    }
    if (std::string_view(info.compiler) != CREVICE_COMPILER_ID) {
        throw Error(
            fmt::format("plugin '{}' was built by {}, this program by {}", file, info.compiler, CREVICE_COMPILER_ID),
            "build both with the same compiler: C++ classes cross the border between them");
    }
    if (std::string_view(info.buildType) != CREVICE_BUILD_TYPE) {
        throw Error(
            fmt::format("plugin '{}' is a {} build, this program a {} build", file, info.buildType, CREVICE_BUILD_TYPE),
            "build the plugin with the same CMAKE_BUILD_TYPE");
    }
}

/// All classes of a plugin or none: a half-registered one would leave factories whose code is gone.
void registerAside(void (*registerStages)(StageRegistry&), const std::string& file, StageRegistry& registry) {
    StageRegistry aside = registry;
    aside.setOrigin(file);
    try {
        registerStages(aside);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {  // Its type may live in the plugin.
        throw Error(fmt::format("plugin '{}' failed to register its stages: {}", file, error.what()));
    }
    aside.setOrigin("builtin");
    registry = std::move(aside);
}

}  // namespace

Plugin::Plugin(const std::filesystem::path& path, StageRegistry& registry) : path_(path) {
    const std::string file = path.string();
    if (!std::filesystem::exists(path)) {
        throw Error(fmt::format("plugin '{}' does not exist", file),
                    "give the path of the shared library: --plugin ./libNAME.so");
    }
    handle_ = dlopen(std::filesystem::absolute(path).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle_)
        throw Error(fmt::format("plugin '{}' cannot be loaded: {}", file, dlerror()),
                    "it has to be a shared library made by crevice_add_plugin(); ldd shows what it lacks");

    const auto* info = static_cast<const PluginInfo*>(dlsym(handle_, "crevice_plugin_info"));
    const auto registerStages = reinterpret_cast<void (*)(StageRegistry&)>(dlsym(handle_, "crevice_register_stages"));
    try {
        if (!info || !registerStages) {
            throw Error(fmt::format("'{}' is no Crevice plugin: it exports no {}", file,
                                    info ? "crevice_register_stages" : "crevice_plugin_info"),
                        "register the stages with CREVICE_PLUGIN(registry) { … }");
        }
        checkInfo(*info, file);
        registerAside(registerStages, file, registry);
    } catch (...) {
        dlclose(handle_);
        throw;
    }
}

Plugin::~Plugin() {
    if (handle_) dlclose(handle_);
}

Plugin::Plugin(Plugin&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), path_(std::move(other.path_)) {}

}  // namespace crevice
