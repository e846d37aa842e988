// What scenes with a Cocos project are made of: built-in shapes, tangents, materials of glTF in the words of
// builtin-standard.
#include "cocos/scene/Shapes.h"

#include <gtest/gtest.h>

#include "cocos/assets/StandardMaterial.h"
#include "cocos/scene/Tangents.h"

namespace crevice::cocos {
namespace {

TEST(CocosShapes, HaveTheSizesThatCocosDocuments) {
    struct Case {
        const char *id, *name;
        glm::vec3 half;
    };
    for (const Case& c : {Case{"a804a", "box", {0.5f, 0.5f, 0.5f}}, Case{"17020", "sphere", {0.5f, 0.5f, 0.5f}},
                          Case{"801ec", "capsule", {0.5f, 1, 0.5f}}, Case{"8abdc", "cylinder", {0.5f, 1, 0.5f}},
                          Case{"38fd2", "cone", {0.5f, 0.5f, 0.5f}}, Case{"40ece", "torus", {0.5f, 0.1f, 0.5f}},
                          Case{"2e76e", "plane", {5, 0, 5}}, Case{"fc873", "quad", {0.5f, 0.5f, 0}}}) {
        EXPECT_EQ(shapeName(c.id), c.name);
        const auto mesh = makeShape(c.name);
        ASSERT_TRUE(mesh) << c.name;
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(mesh->bounds.max[k], c.half[k], 0.01f) << c.name << k;
            EXPECT_NEAR(mesh->bounds.min[k], -c.half[k], 0.01f) << c.name << k;
        }
        for (const Vertex& vertex : mesh->vertices) {
            EXPECT_GE(vertex.uv0.x, 0) << c.name;
            EXPECT_LE(vertex.uv0.y, 1) << c.name;
        }
    }
    EXPECT_EQ(makeShape("quad")->vertices.front().normal, glm::vec3(0, 0, 1));
    EXPECT_FALSE(makeShape("teapot"));
    EXPECT_EQ(shapeName("00000"), "");
}

TEST(CocosTangents, PointWhereUGrows) {
    Mesh mesh;
    mesh.vertices = {{.position = {0, 0, 0}, .uv0 = {0, 0}},
                     {.position = {0, 2, 0}, .uv0 = {1, 0}},
                     {.position = {2, 0, 0}, .uv0 = {0, 1}}};
    mesh.indices = {0, 1, 2};
    addTangents(mesh);
    EXPECT_TRUE(mesh.hasTangents);
    EXPECT_NEAR(mesh.vertices[0].tangent.y, 1, 1e-6);
    EXPECT_EQ(mesh.vertices[0].tangent.w, -1);  // u grows along y, v along x, seen from +z: mirrored
    mesh.vertices[1].uv0 = {0, 0};
    mesh.vertices[2].uv0 = {0, 0};
    addTangents(mesh);
    EXPECT_NEAR(glm::length(glm::vec3(mesh.vertices[0].tangent)), 1, 1e-6);
}

TEST(CocosTangents, LeaveFurtherTextureCoordinatesAlone) {
    Mesh mesh = *makeShape("quad");
    mesh.hasTangents = false;
    for (Vertex& vertex : mesh.vertices) vertex.tangent = {5, 6, 7, 8};
    SceneMaterial material;
    addTangentsFor(material, mesh);
    EXPECT_FALSE(mesh.hasTangents);
    material.normalMap = {.texture = 1, .texcoord = 1};
    material.emissiveMap = {.texture = 2, .texcoord = 3};
    addTangentsFor(material, mesh);
    EXPECT_EQ(mesh.vertices[0].tangent, glm::vec4(5, 6, 7, 8));
    EXPECT_TRUE(dropFurtherCoordinates(material));
    EXPECT_EQ(material.normalMap.texture, 1);
    EXPECT_FALSE(material.emissiveMap);
    EXPECT_FALSE(dropFurtherCoordinates(material));
    addTangentsFor(material, mesh);
    EXPECT_TRUE(mesh.hasTangents);
    EXPECT_NEAR(glm::length(glm::vec3(mesh.vertices[0].tangent)), 1, 1e-6);
}

TEST(CocosStandard, GltfMaterialsUseTheWordsOfTheEditorsImporter) {
    SceneMaterial material;
    material.baseColor = {0.5f, 0.25f, 1, 0.5f};
    material.metallic = 0.125f;
    material.roughness = 0.75f;
    material.emissive = {2, 0, 0};
    material.normalMap = {.texture = 3, .texcoord = 1};
    material.alphaMode = AlphaMode::Mask;
    material.doubleSided = true;
    EffectAsset standard;
    standard.techniques.push_back({"opaque", {EffectPass{}, EffectPass{}}});
    standard.techniques.push_back({"transparent", {EffectPass{}}});
    const Mtl mtl = makeStandardMtl(material, standard);
    EXPECT_EQ(mtl.technique, 0u);
    ASSERT_EQ(mtl.passes.size(), 2u);
    EXPECT_EQ(
        mtl.passes[1].defines.toJson(-1),
        R"({"USE_NORMAL_MAP":true,"NORMAL_UV":"v_uv1","HAS_SECOND_UV":true,"USE_ALPHA_TEST":true,"USE_TWOSIDE":true})");
    EXPECT_EQ(mtl.passes[0].states.toJson(-1), R"({"rasterizerState":{"cullMode":0}})");
    std::string values;
    for (const MtlProperty& property : mtl.passes[0].properties)
        values += property.name + "=" +
                  (property.value.plain.isNull() ? property.value.asset.uuid : property.value.plain.toJson(-1)) + ";";
    EXPECT_EQ(
        values,
        "mainColor=[1,1,1,0.5];albedoScale=[0.5,0.25,1];metallic=0.125;roughness=0.75;occlusion=1;normalStrenth=1;"
        "emissive=[1,1,1,1];emissiveScale=[2,0,0];normalMap=scene:3;alphaThreshold=0.5;");
    EXPECT_EQ(sceneTextureOf(mtl.passes[0].properties[8].value.asset), 3);
    EXPECT_EQ(sceneTextureOf({.uuid = "10ff50d1-0000-4000-8000-000000f1736b"}), -1);
    material.alphaMode = AlphaMode::Blend;
    EXPECT_EQ(makeStandardMtl(material, standard).technique, 1u);
}

}  // namespace
}  // namespace crevice::cocos
