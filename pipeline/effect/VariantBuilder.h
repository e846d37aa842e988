// From an effect's pass and macro values to the texts of its stages: flatten, check defines, add head and entry.
#pragma once

#include <vector>

#include "effect/Defines.h"
#include "effect/EffectLibrary.h"
#include "effect/ShaderCompiler.h"

namespace crevice {

/// A program reference "name:entry" taken apart.
struct ProgramReference {
    std::string program, entry;
};
ProgramReference parseProgram(const std::string& reference);

/// With an entry, main() is ours: one more line hands the entry's result to the place where the stage's result goes.
/// Errors in it are the pass': `where`.
void appendEntry(FlatSource& flat, ShaderStageBits stage, const std::string& entry, const SourceLoc& where);

/// A stage that a pass names, and where it does.
struct StagePart {
    ShaderStageBits stage;
    const std::string& reference;
    const SourceLoc& where;
};
/// Vertex before fragment. Refers to the pass.
std::vector<StagePart> partsOf(const EffectPass& pass);

/// The flattened stages of a pass, vertex before fragment.
struct FlatPass {
    std::vector<ShaderStageBits> stages;
    std::vector<FlatSource> sources;
    std::vector<const FlatSource*> pointers() const;
};
FlatPass flattenPass(const IncludeSources& sources, const EffectPass& pass, Problems& problems);

/// The texts handed to the compiler. The pass' own embedded macros join `values`; a request that contradicts them is an
/// error, as is a macro that no pass of the effect knows. `knownElsewhere` lists the macros of the effect's other
/// passes.
std::vector<StageSource> makeStageSources(FlatPass flat, const EffectPass& pass, const VariantRequest& request,
                                          const std::vector<std::string>& knownElsewhere, Problems& problems);

/// Reports properties whose target no text of the effect mentions, in any pass or branch.
void checkPropertyTargets(const IncludeSources& sources, const EffectPass& pass, const std::vector<StageSource>& stages,
                          Problems& problems);

}  // namespace crevice
