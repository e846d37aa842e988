// A plugin whose papers are wrong in one point, chosen by macros; package.sh builds one of each.
#include "flow/Plugin.h"

#ifndef ABI
#define ABI crevice::kPluginAbi
#endif
#ifndef COMPILER
#define COMPILER CREVICE_COMPILER_ID
#endif
#ifndef BUILD_TYPE
#define BUILD_TYPE CREVICE_BUILD_TYPE
#endif

#ifndef NO_PLUGIN
extern "C" {
extern const crevice::PluginInfo crevice_plugin_info;
const crevice::PluginInfo crevice_plugin_info = {ABI, COMPILER, BUILD_TYPE};
void crevice_register_stages(crevice::StageRegistry&) {}
}
#endif
