// What scenes of glTF need from drawing: points and lines, unlit materials, transformed textures.
#include "FrameFixture.h"

namespace crevice {
namespace {

class GltfDraw : public FrameTest {
protected:
    static int countLit(const Image& image) {
        int count = 0;
        for (std::uint32_t y = 0; y < image.height; ++y)
            for (std::uint32_t x = 0; x < image.width; ++x) count += image.at(x, y).x > 0.5f;
        return count;
    }
};

TEST_F(GltfDraw, UnlitSurfacesGiveOffTheirColourWhateverLightThereIs) {
    for (const char* pipeline : {"deferred", "forward"})
        for (const bool lit : {false, true}) {
            Scene scene = darkScene();
            scene.materials[0].unlit = true;
            scene.materials[0].baseColor = {0.25f, 0.5f, 0.75f, 1};
            addWall(scene, 20);
            if (lit) {
                scene.lights = {directional({0, 0, -1}, 3)};
                scene.ambient = Ambient{glm::vec3(1), glm::vec3(1)};
            }
            const glm::vec4 color = radianceOf(scene, pipeline).at(3, 3);
            EXPECT_NEAR(color.x, 0.25f, kHalfUnit) << pipeline << lit;
            EXPECT_NEAR(color.y, 0.5f, kHalfUnit) << pipeline << lit;
            EXPECT_NEAR(color.z, 0.75f, kHalfUnit) << pipeline << lit;
        }
}

TEST_F(GltfDraw, PointsAndLinesAreOnePixelWide) {
    for (const char* pipeline : {"deferred", "forward"}) {
        Scene scene = darkScene();
        scene.materials[0].unlit = true;
        Mesh points;
        points.topology = MeshTopology::Points;
        points.vertices.resize(3);
        points.vertices[0].position = {-0.3f, 0.3f, 0};
        points.vertices[1].position = {0.3f, 0.3f, 0};
        points.vertices[2].position = {0.3f, -0.3f, 0};
        points.indices = {0, 1, 2};
        addObject(scene, points, glm::mat4(1));
        EXPECT_EQ(countLit(radianceOf(scene, pipeline, 32)), 3) << pipeline;

        // A level line covers one row; it has as many pixels as it is wide, give or take its ends.
        Scene lines = darkScene();
        lines.materials[0].unlit = true;
        points.topology = MeshTopology::Lines;
        points.indices = {0, 1};
        addObject(lines, points, glm::mat4(1));
        const Image image = radianceOf(lines, pipeline, 32);
        std::uint32_t rows = 0;
        for (std::uint32_t y = 0; y < image.height; ++y) rows += countLit(cropped(image, {0, y}, {image.width, 1})) > 0;
        EXPECT_EQ(rows, 1u) << pipeline;
        EXPECT_GT(countLit(image), 2) << pipeline;
    }
}

// A texture of two texels, black and white, side by side. Shifted by half its width they change places.
TEST_F(GltfDraw, TextureTransformsMoveTheTexture) {
    for (const char* pipeline : {"deferred", "forward"}) {
        Scene scene = darkScene();
        SceneTexture texture;
        texture.image = Image(2, 1, Format::RGBA8);
        for (int c = 0; c < 4; ++c) {
            texture.image.pixels[std::size_t(c)] = std::byte(c == 3 ? 255 : 0);
            texture.image.pixels[std::size_t(4 + c)] = std::byte(255);
        }
        texture.sampler.linearMag = texture.sampler.linearMin = texture.sampler.mipmaps = false;
        scene.textures.push_back(texture);
        scene.materials[0].emissive = glm::vec3(1);
        scene.materials[0].emissiveMap.texture = 0;
        addWall(scene, 20);
        for (Vertex& vertex : scene.meshes[0].vertices) vertex.uv0 = {0.25f, 0.5f};  // the black texel
        EXPECT_EQ(radianceOf(scene, pipeline).at(3, 3).x, 0) << pipeline;
        scene.materials[0].emissiveMap.transform.offset = {0.5f, 0};
        EXPECT_NEAR(radianceOf(scene, pipeline).at(3, 3).x, 1, kHalfUnit) << pipeline;
        // Half a turn leads to (-0.25, -0.5), which repeats as 0.75: the white one.
        scene.materials[0].emissiveMap.transform = {.rotation = 3.14159265f};
        EXPECT_NEAR(radianceOf(scene, pipeline).at(3, 3).x, 1, kHalfUnit) << pipeline;
    }
}

}  // namespace
}  // namespace crevice
