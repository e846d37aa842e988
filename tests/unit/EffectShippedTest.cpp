// Every technique and pass of every shipped effect compiles with its default macros and the contract's binding numbers.
#include <gtest/gtest.h>

#include "EffectTestTools.h"

namespace crevice {
namespace {

TEST(EffectShipped, EveryPassCompilesWithDefaultDefines) {
    const AssetRoots roots({std::filesystem::path(CREVICE_SOURCE_DIR)});
    EffectLibrary library(roots, Log(LogLevel::Error), {.useDiskCache = false});
    const std::vector<std::string> names = roots.list(AssetKind::Effect);
    ASSERT_FALSE(names.empty());
    for (const std::string& name : names) {
        SCOPED_TRACE(name);
        try {
            const EffectAsset& asset = library.asset(name);
            for (std::size_t t = 0; t < asset.techniques.size(); ++t)
                for (std::size_t p = 0; p < asset.techniques[t].passes.size(); ++p) {
                    VariantRequest request;
                    request.effect = name;
                    request.technique = t;
                    request.pass = p;
                    const EffectVariant& variant = library.get(request, contractBindings());
                    const Material material(variant);
                    EXPECT_TRUE(!variant.compute.empty() || (!variant.vertex.empty() && !variant.fragment.empty()));
                }
        } catch (const Error& error) {
            ADD_FAILURE() << formatError(error);
        }
    }
}

}  // namespace
}  // namespace crevice
