// Faults of the device in the middle of a render: memory that runs out at any allocation, a lost device, a missing
// format. Each is an Error in words; nothing leaks, and the same renderer works again when the fault is over.
#include "FrameFixture.h"

namespace crevice {
namespace {

using testing::HasSubstr;

class FaultTest : public FrameTest {
protected:
    /// Everything from the document to the picture.
    Image renderAnew() {
        load("deferred");
        Scene scene = darkScene();
        addFloor(scene, 4);
        scene.lights.push_back(directional({0, -1, 0}, 3));
        renderer_->setScene(std::move(scene));
        return renderer_->render({.width = 32, .height = 18});
    }
    std::string errorWith(const DeviceFaults& faults) {
        renderer_->device().setFaults(faults);
        try {
            renderAnew();
        } catch (const RenderError& error) {
            return formatError(error);
        }
        return "";
    }
};

TEST_F(FaultTest, EveryFailedAllocationIsAnErrorAndTheRendererRecovers) {
    const Image expected = renderAnew();
    int failures = 0;
    for (;; ++failures) {
        const std::string error = errorWith({.failAllocation = failures});
        if (error.empty()) break;
        SCOPED_TRACE(failures);
        ASSERT_THAT(error, HasSubstr("out of GPU memory: '"));
        ASSERT_THAT(error, HasSubstr("help: render fewer pixels with --size, or a smaller scene"));
    }
    EXPECT_GE(failures, 12) << "a frame has a G-buffer, a depth, a shadow map, meshes, blocks and a readback";
    renderer_->device().setFaults({});
    EXPECT_EQ(renderAnew(), expected);
}

TEST_F(FaultTest, ALostDeviceIsAnErrorAtEverySubmission) {
    const Image expected = renderAnew();
    int failures = 0;
    for (;; ++failures) {
        const std::string error = errorWith({.loseDevice = failures});
        if (error.empty()) break;
        SCOPED_TRACE(failures);
        ASSERT_THAT(error, HasSubstr("was lost while it ran '"));
        ASSERT_THAT(error, HasSubstr("choose another device with --device"));
    }
    EXPECT_GE(failures, 2) << "an upload and a frame";
    renderer_->device().setFaults({});
    EXPECT_EQ(renderAnew(), expected);
}

TEST_F(FaultTest, AFormatThatTheDriverLacksIsNamedWithItsTarget) {
    const std::string error = [&]() -> std::string {
        renderer_->device().setFaults({.missingFormat = Format::RGBA16F});
        try {
            renderAnew();
        } catch (const Error& failure) {
            return formatError(failure);
        }
        return "";
    }();
    EXPECT_THAT(error, HasSubstr("cannot use format 'RGBA16F'"));
    EXPECT_THAT(error, HasSubstr("choose another format; `crevice info` lists what the device can do"));
}

TEST(FaultDevice, ADriverWithoutANeededFormatIsNotChosen) {
    const Log quiet(LogLevel::Error, [](LogLevel, std::string_view) {});
    try {
        const Device device({.log = quiet, .faults = {.missingFormat = Format::D32F}});
        ADD_FAILURE() << "the device was taken";
    } catch (const Error& error) {
        EXPECT_THAT(formatError(error), HasSubstr("'D32F' as sampled depth attachment"));
    }
}

}  // namespace
}  // namespace crevice
