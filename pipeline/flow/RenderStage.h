// The interface of a stage: the one header that a stage author includes. See docs/writing-a-stage.md.
//
// Life of a stage: construct → params() → declare() → plan → activate() → render()*; after a resize or a changed
// parameter activate() is called again. Nothing GPU exists before activate(), nothing is created in render().
#pragma once

#include "core/Params.h"
#include "flow/FrameContext.h"
#include "flow/Plugin.h"
#include "flow/StageIo.h"
#include "flow/StageRegistry.h"

namespace crevice {

/// What is known when a stage is activated, and what it may still set.
class StageSetup {
public:
    virtual ~StageSetup() = default;
    virtual const Scene& scene() const = 0;
    virtual const Aabb& sceneBounds() const = 0;  ///< World space.
    virtual glm::uvec2 extent() const = 0;        ///< Pixels of the frame.
    /// A property that depends on the scene. A value in the document wins.
    virtual void setProperty(DrawId draw, std::string_view name, const Value& value) = 0;
};

class RenderStage {
public:
    virtual ~RenderStage() = default;

    /// List the fields read from "params", once; called before declare(), and for `crevice stages`, schema and docs.
    virtual void params(ParamVisitor& visitor) { (void)visitor; }
    /// Name what is written, provided and drawn. Reads are found in the effects.
    virtual void declare(StageIo& io) = 0;
    /// Everything exists now: compute what does not change from frame to frame.
    virtual void activate(StageSetup& setup) { (void)setup; }
    /// Record. Targets are bound, barriers are done.
    virtual void render(FrameContext& frame) = 0;
};

}  // namespace crevice
