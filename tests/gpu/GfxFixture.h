// A validated device per test: at the end no message was sent and no object is left over.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/Image.h"
#include "core/Log.h"
#include "gfx/Commands.h"
#include "gfx/Device.h"
#include "gfx/Readback.h"

namespace crevice {

class GfxTest : public testing::Test {
protected:
    void SetUp() override {
        device_ = std::make_unique<Device>(DeviceOptions{.log = log_, .validate = true, .syncValidation = true});
    }
    void TearDown() override {
        EXPECT_EQ(device_->validationMessageCount(), 0u) << (messages_.empty() ? "" : messages_.front());
        EXPECT_EQ(device_->liveObjects(), LiveObjects{}) << device_->liveObjects().text();
        device_.reset();
        EXPECT_TRUE(messages_.empty()) << messages_.front();
    }

    /// Pixels that differ from each other in every byte's low bits; every byte is a valid one of the format.
    static Image pattern(std::uint32_t width, std::uint32_t height, Format format) {
        Image image(width, height, format);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            image.pixels[i] = static_cast<std::byte>((i * 37 + 11) & 0x3f);  // below 0x40: no NaN in any float format
        }
        return image;
    }

    std::vector<std::string> messages_;
    Log log_{LogLevel::Warning, [this](LogLevel, std::string_view text) { messages_.emplace_back(text); }};
    std::unique_ptr<Device> device_;
};

}  // namespace crevice
