// The full-screen quad that Cocos' effects are drawn on, and zeroes for attributes that nothing feeds.
#pragma once

#include "gfx/Commands.h"

namespace crevice {

class QuadMesh {
public:
    explicit QuadMesh(Device& device);
    /// As stream 0, with its indices.
    void bind(Commands& commands) const;
    /// The zeroes, as stream 2.
    void bindZeroes(Commands& commands) const;
    void draw(Commands& commands) const;

private:
    Buffer vertices_, indices_, zeroes_;
};

}  // namespace crevice
