// The other side of a comparison: Embree 3, one ray at a time on one thread.
//
//     embree TRIANGLES RAYS HITS
//
// TRIANGLES: 9 floats each. RAYS: 6 floats each, origin and direction. Writes
// the index of the triangle that each ray meets first (2^32 - 1 for none) to
// HITS.fast and HITS.robust. Then, for each line "fast" or "robust" on standard
// input, traces all rays and answers with the seconds it took: of processor
// time and on the wall.

#include <embree3/rtcore.h>
#include <limits>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

static std::vector<float> floats(const char* path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    std::vector<float> values(static_cast<size_t>(file.tellg()) / sizeof(float));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(values.data()), values.size() * sizeof(float));
    if (!file) {
        std::fprintf(stderr, "cannot read %s\n", path);
        std::exit(1);
    }
    return values;
}

static double seconds(clockid_t clock) {
    timespec time;
    clock_gettime(clock, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

static RTCScene build(RTCDevice device, const std::vector<float>& triangles, RTCSceneFlags flags) {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, flags);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const size_t corners = triangles.size() / 3;
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), corners));
    std::memcpy(vertices, triangles.data(), triangles.size() * sizeof(float));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), corners / 3));
    for (size_t i = 0; i < corners; i++) indices[i] = static_cast<uint32_t>(i);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene);
    return scene;
}

// Sum over the answers, so that none can be left out by the compiler.
static double trace(RTCScene scene, const std::vector<float>& rays, uint32_t* hits) {
    double sum = 0;
    for (size_t i = 0; i < rays.size() / 6; i++) {
        const float* from = &rays[6 * i];
        RTCRayHit query;
        query.ray.org_x = from[0];
        query.ray.org_y = from[1];
        query.ray.org_z = from[2];
        query.ray.dir_x = from[3];
        query.ray.dir_y = from[4];
        query.ray.dir_z = from[5];
        query.ray.tnear = 0;
        query.ray.tfar = std::numeric_limits<float>::infinity();
        query.ray.time = 0;
        query.ray.mask = ~0u;
        query.ray.id = 0;
        query.ray.flags = 0;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene, &context, &query);
        const bool hit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        sum += hit ? query.ray.tfar + query.hit.u + query.hit.v : -1;
        if (hits) hits[i] = hit ? query.hit.primID : ~0u;
    }
    return sum;
}

static volatile double answer;

int main(int count, char** arguments) {
    if (count != 4) return 2;
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON); // as Embree's manual advises
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    const auto triangles = floats(arguments[1]);
    const auto rays = floats(arguments[2]);
    RTCDevice device = rtcNewDevice("threads=1");
    if (!device) {
        std::fprintf(stderr, "rtcNewDevice fails with error %d\n", rtcGetDeviceError(nullptr));
        return 1;
    }
    const char* names[2] = {"fast", "robust"};
    const RTCScene scenes[2] = {
        build(device, triangles, RTC_SCENE_FLAG_NONE),
        build(device, triangles, RTC_SCENE_FLAG_ROBUST),
    };
    for (int i = 0; i < 2; i++) {
        std::vector<uint32_t> hits(rays.size() / 6);
        answer = trace(scenes[i], rays, hits.data());
        std::ofstream file(std::string(arguments[3]) + "." + names[i], std::ios::binary);
        file.write(reinterpret_cast<const char*>(hits.data()), hits.size() * sizeof(uint32_t));
        if (!file) return 1;
    }
    std::printf("Embree %d\n", int(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION)));
    std::fflush(stdout);
    char line[64];
    while (std::fgets(line, sizeof line, stdin)) {
        const RTCScene scene = scenes[std::strncmp(line, "robust", 6) == 0];
        const double cpu = seconds(CLOCK_PROCESS_CPUTIME_ID), wall = seconds(CLOCK_MONOTONIC);
        answer = trace(scene, rays, nullptr);
        const double cpu_s = seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu;
        std::printf("%.9f %.9f\n", cpu_s, seconds(CLOCK_MONOTONIC) - wall);
        std::fflush(stdout);
    }
}
