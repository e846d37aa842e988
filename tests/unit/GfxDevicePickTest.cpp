// Which driver is chosen and what is said about those that cannot be.
#include "gfx/DevicePick.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace crevice {
namespace {

using testing::HasSubstr;

DeviceInfo make(const char* name, const char* type, const char* problem = "") {
    return {.name = name, .type = type, .driver = std::string("driver of ") + name, .api = "1.3.0", .problem = problem};
}

std::string failureOf(const std::vector<DeviceInfo>& devices, const std::string& wanted) {
    try {
        chooseDevice(devices, wanted);
    } catch (const Error& error) {
        return formatError(error);
    }
    return "";
}

TEST(GfxDevicePick, PrefersDiscreteThenIntegratedThenCpu) {
    EXPECT_EQ(chooseDevice({make("a", "cpu"), make("b", "integrated"), make("c", "discrete")}, ""), 2u);
    EXPECT_EQ(chooseDevice({make("a", "cpu"), make("b", "integrated")}, ""), 1u);
    EXPECT_EQ(chooseDevice({make("a", "other"), make("b", "cpu")}, ""), 1u);
    EXPECT_EQ(chooseDevice({make("a", "discrete"), make("b", "discrete")}, ""), 0u) << "equal ones: the first";
}

TEST(GfxDevicePick, UnusableDevicesAreAvoided) {
    EXPECT_EQ(chooseDevice({make("a", "discrete", "it has Vulkan 1.1, 1.3 is needed"), make("b", "cpu")}, ""), 1u);
}

TEST(GfxDevicePick, NameIndexAndDriverSelect) {
    const std::vector<DeviceInfo> devices = {make("Big GPU", "discrete"), make("llvmpipe", "cpu")};
    EXPECT_EQ(chooseDevice(devices, "LLVM"), 1u);
    EXPECT_EQ(chooseDevice(devices, "1"), 1u);
    EXPECT_EQ(chooseDevice(devices, "driver of big"), 0u);
}

TEST(GfxDevicePick, FailuresSayWhatToDo) {
    EXPECT_THAT(failureOf({}, ""), HasSubstr("install your GPU's driver, or mesa-vulkan-drivers"));
    EXPECT_THAT(failureOf({make("a", "cpu")}, "9"), HasSubstr("no Vulkan device '9'"));
    const std::string refused =
        failureOf({make("old", "discrete", "it lacks feature 'synchronization2'"), make("b", "cpu")}, "old");
    EXPECT_THAT(refused, HasSubstr("device 'old' cannot be used: it lacks feature 'synchronization2'"));
    EXPECT_THAT(refused, HasSubstr("1: 'b' (cpu)"));
}

TEST(GfxDevicePick, ProblemsNameEverythingMissing) {
    DeviceFacts facts{.apiVersion = VK_API_VERSION_1_3,
                      .graphicsComputeQueue = true,
                      .dynamicRendering = true,
                      .synchronization2 = true,
                      .maintenance4 = true,
                      .robustBufferAccess = true,
                      .storageImageExtendedFormats = true};
    EXPECT_EQ(describeProblem(facts), "");
    facts.maintenance4 = false;
    facts.missingFormats = {"'R32F' as storage image"};
    EXPECT_EQ(describeProblem(facts), "it lacks feature 'maintenance4', format 'R32F' as storage image");
    facts.apiVersion = VK_API_VERSION_1_2;
    EXPECT_EQ(describeProblem(facts), "it has Vulkan 1.2, 1.3 is needed");
}

}  // namespace
}  // namespace crevice
