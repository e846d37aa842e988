// The device: who is chosen, what it says when it cannot be made, and whether validation is awake.
#include "gfx/Device.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "GfxFixture.h"
#include "tests/ScopedVariable.h"

namespace crevice {
namespace {

using test::ScopedVariable;
using testing::HasSubstr;

/// The message and help of the error that making the device throws; empty when it does not.
std::string failureOf(const DeviceOptions& options) {
    try {
        const Device device(options);
    } catch (const Error& error) {
        return formatError(error);
    }
    return "";
}

const Log& quietLog() {
    static const Log log(LogLevel::Error, [](LogLevel, std::string_view) {});
    return log;
}

TEST_F(GfxTest, DeviceTellsWhatItIs) {
    EXPECT_FALSE(device_->deviceName().empty());
    EXPECT_FALSE(device_->driverInfo().empty());
    EXPECT_GE(device_->limits().maxImageDimension2D, 4096u);
    EXPECT_GT(device_->heapBytes(), std::uint64_t(64) << 20);
    EXPECT_EQ(device_->allocatedBytes(), 0u);
    EXPECT_TRUE(device_->validates());
}

TEST(GfxDevice, ListContainsTheChosenDevice) {
    const std::vector<DeviceInfo> devices = Device::listDevices();
    ASSERT_FALSE(devices.empty());
    const Device device({.log = quietLog()});
    const auto same = [&](const DeviceInfo& info) { return info.name == device.deviceName() && info.problem.empty(); };
    EXPECT_TRUE(std::any_of(devices.begin(), devices.end(), same));
}

TEST(GfxDevice, IsChosenByIndexAndByPartOfItsNameInAnyCase) {
    const Device byIndex({.log = quietLog(), .device = "0"});
    EXPECT_EQ(byIndex.deviceName(), Device::listDevices().at(0).name);
    std::string part = byIndex.deviceName().substr(0, 4);
    for (char& letter : part) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    EXPECT_EQ(Device({.log = quietLog(), .device = part}).deviceName(), byIndex.deviceName());
}

TEST(GfxDevice, UnknownNameListsWhatThereIs) {
    const std::string message = failureOf({.log = quietLog(), .device = "nosuchgpu"});
    EXPECT_THAT(message, HasSubstr("no Vulkan device 'nosuchgpu'"));
    EXPECT_THAT(message, HasSubstr("0: '" + Device::listDevices().at(0).name + "'"));
}

TEST(GfxDevice, NoDriverIsSaidInWords) {
    const ScopedVariable icd("VK_ICD_FILENAMES", "/nonexistent/icd.json");
    const ScopedVariable driver("VK_DRIVER_FILES", "/nonexistent/icd.json");
    const std::string message = failureOf({.log = quietLog()});
    EXPECT_THAT(message, HasSubstr("no Vulkan driver was found"));
    EXPECT_THAT(message, HasSubstr("mesa-vulkan-drivers"));
    EXPECT_TRUE(Device::listDevices().empty());
}

TEST(GfxDevice, MissingValidationLayerIsSaidInWords) {
    const ScopedVariable layers("VK_LAYER_PATH", "/nonexistent");
    const std::string message = failureOf({.log = quietLog(), .validate = true});
    EXPECT_THAT(message, HasSubstr("validation layer is not installed"));
    EXPECT_THAT(message, HasSubstr("vulkan-validationlayers"));
}

// Canaries: when these fail, the layer is silent and "zero messages" elsewhere means nothing.

class GfxCanary : public testing::Test {
protected:
    std::vector<std::string> messages_;
    Log log_{LogLevel::Warning, [this](LogLevel, std::string_view text) { messages_.emplace_back(text); }};
    TextureDesc desc_{.usage = TextureUsage::Color | TextureUsage::Sampled | TextureUsage::TransferSource,
                      .name = "canaryTarget"};
};

TEST_F(GfxCanary, WrongOldLayoutIsCountedAndNamesTheTexture) {
    Device device({.log = log_, .validate = true});
    const GpuTexture texture(device, desc_);
    Commands commands(device);
    commands.begin();
    commands.barrier(texture, TextureState::Undefined, TextureState::Color);
    commands.barrier(texture, TextureState::Sampled, TextureState::TransferSource);  // it is in Color
    commands.submitAndWait();
    EXPECT_GE(device.validationMessageCount(), 1u);
    EXPECT_EQ(device.validationMessages().size(), device.validationMessageCount());
    ASSERT_FALSE(messages_.empty());
    EXPECT_THAT(messages_.front(), HasSubstr("canaryTarget"));
}

TEST_F(GfxCanary, CopyFromTheWrongStateIsCountedUnderItsLabel) {
    Device device({.log = log_, .validate = true});
    const GpuTexture texture(device, desc_);
    const Buffer buffer(device, {.size = 4, .usage = BufferUsage::TransferDest, .access = BufferAccess::HostRead});
    Commands commands(device);
    commands.begin();
    commands.barrier(texture, TextureState::Undefined, TextureState::Sampled);
    commands.beginLabel("the wrong copy");
    commands.copyTextureToBuffer(texture, buffer);  // needs TransferSource
    commands.endLabel();
    commands.submitAndWait();
    ASSERT_GE(device.validationMessageCount(), 1u);
    EXPECT_THAT(device.validationMessages().front(), HasSubstr("recorded in 'the wrong copy'"));
}

TEST_F(GfxCanary, MissingBarrierIsCountedBySyncValidationOnly) {
    for (const bool sync : {false, true}) {
        Device device({.log = log_, .validate = true, .syncValidation = sync});
        const Buffer buffer(device, {.size = 64, .usage = BufferUsage::TransferDest, .access = BufferAccess::HostRead});
        Commands commands(device);
        commands.begin();
        commands.fillBuffer(buffer, 1);
        commands.fillBuffer(buffer, 2);  // a write after a write, unordered
        commands.submitAndWait();
        EXPECT_EQ(device.validationMessageCount() > 0, sync);
    }
}

TEST_F(GfxCanary, ObjectsThatOutliveTheDeviceAreReported) {
    auto device = std::make_unique<Device>(DeviceOptions{.log = log_});
    ++device->live()[ObjectKind::Sampler];
    device.reset();
    ASSERT_EQ(messages_.size(), 1u);
    EXPECT_THAT(messages_.front(), HasSubstr("samplers 1"));
}

}  // namespace
}  // namespace crevice
