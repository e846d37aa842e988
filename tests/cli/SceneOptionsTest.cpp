// What a scene may read and how much: --allow-path, --limit, and messages that name them.
#include "CliTools.h"

namespace crevice::cli {
namespace {

/// A triangle whose buffer lies beside the scene's folder.
constexpr const char* kTriangle = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36, "uri": "../shared/triangle.bin"}]})";

class SceneOptionsTest : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        std::filesystem::create_directories(path("scene"));
        std::filesystem::create_directories(path("shared"));
        const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
        write("shared/triangle.bin", std::string(reinterpret_cast<const char*>(corners), sizeof corners));
        write("scene/a.gltf", kTriangle);
    }
};

TEST_F(SceneOptionsTest, FilesOutsideTheSceneFolderNeedAllowPath) {
    const Outcome refused = run("info scene/a.gltf");
    EXPECT_EQ(refused.code, 2);
    expectHas(refused.err, "lies outside the scene's folder");
    const Outcome allowed = run("info scene/a.gltf --allow-path shared");
    EXPECT_EQ(allowed.code, 0) << allowed.err;
    expectHas(allowed.out, "triangles");
    EXPECT_EQ(run("info scene/a.gltf --allow-path scene").code, 2) << "another folder allows nothing";
}

TEST_F(SceneOptionsTest, ALinkDoesNotLeadOut) {
    std::filesystem::create_symlink(path("shared"), path("scene/link"));
    std::string linked = kTriangle;
    linked.replace(linked.find("../shared"), 9, "link");
    write("scene/a.gltf", linked);
    EXPECT_EQ(run("info scene/a.gltf").code, 2);
    EXPECT_EQ(run("info scene/a.gltf --allow-path shared").code, 0);
}

TEST_F(SceneOptionsTest, LimitsAreKeptAndNamed) {
    const Outcome refused = run("info scene/a.gltf --allow-path shared --limit vertices=2");
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(run("info scene/a.gltf --allow-path shared --limit vertices=3").code, 0);
}

}  // namespace
}  // namespace crevice::cli
