// The full-screen quad that Cocos' effects are drawn on, and attributes that are the same for all vertices.
#pragma once

#include "gfx/Commands.h"

namespace crevice {

class QuadMesh {
public:
    explicit QuadMesh(Device& device);
    /// As stream 0, with its indices.
    void bind(Commands& commands) const;
    /// As stream 2: see kSameStream.
    void bindSame(Commands& commands) const;
    void draw(Commands& commands) const;

private:
    Buffer vertices_, indices_, same_;
};

}  // namespace crevice
