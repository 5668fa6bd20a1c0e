// SPDX-License-Identifier: MIT
// The peer of rhw.diff: rasterization as PyTorch3D's documentation describes it for the CPU, written from that
// description. Every pixel looks at every face of its mesh: those whose box it lies in are tested by the signed areas
// of three edges, and the nearest is kept, with perspective-correct weights. Threads share the rows of each picture.
// bench/diff_peers.py compiles it and calls it through ctypes.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <thread>
#include <vector>

namespace {

struct Point {
    float x, y, z; // -1..1 from the left and from below; z: distance along the view
};

struct Face {
    Point corner[3];
};

// Of all faces, one array for each side.
struct Boxes {
    std::vector<float> left, right, bottom, top;
};

struct Pictures {
    int width, height;
    int32_t *face; // -1: none
    float *depth, (*weights)[3];
};

Boxes boxes_of(const Face *faces, int count)
{
    Boxes boxes;
    for (int i = 0; i < count; i++) {
        const auto &c = faces[i].corner;
        boxes.left.push_back(std::min({c[0].x, c[1].x, c[2].x}));
        boxes.right.push_back(std::max({c[0].x, c[1].x, c[2].x}));
        boxes.bottom.push_back(std::min({c[0].y, c[1].y, c[2].y}));
        boxes.top.push_back(std::max({c[0].y, c[1].y, c[2].y}));
    }
    return boxes;
}

// Twice the signed area of the triangle p, a, b.
float area(float x, float y, const Point &a, const Point &b)
{
    return (a.x - x) * (b.y - y) - (a.y - y) * (b.x - x);
}

// Whether the face holds the place (x, y); then with its weights, which are corrected for perspective.
bool weights_at(const Face &face, float x, float y, float weights[3])
{
    const Point *c = face.corner;
    const float whole = area(c[0].x, c[0].y, c[1], c[2]);
    if (whole == 0) {
        return false;
    }
    float over_z[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        const float part = area(x, y, c[(i + 1) % 3], c[(i + 2) % 3]) / whole;
        if (!(part > 0)) {
            return false;
        }
        over_z[i] = part / c[i].z;
        sum += over_z[i];
    }
    for (int i = 0; i < 3; i++) {
        weights[i] = over_z[i] / sum;
    }
    return true;
}

void draw_pixel(const Face *faces, int count, const Boxes &boxes, int column, int row, const Pictures &out)
{
    const float x = (2.0f * (float)column + 1.0f) / (float)out.width - 1.0f;
    const float y = (2.0f * (float)row + 1.0f) / (float)out.height - 1.0f;
    const size_t at = (size_t)row * (size_t)out.width + (size_t)column;
    float nearest = std::numeric_limits<float>::infinity();
    out.face[at] = -1;
    for (int i = 0; i < count; i++) {
        const size_t f = (size_t)i;
        float w[3];
        if ((x < boxes.left[f]) | (x > boxes.right[f]) | (y < boxes.bottom[f]) | (y > boxes.top[f]) ||
            !weights_at(faces[f], x, y, w)) {
            continue;
        }
        const Point *c = faces[f].corner;
        const float depth = w[0] * c[0].z + w[1] * c[1].z + w[2] * c[2].z;
        if (depth >= 0 && depth < nearest) {
            nearest = depth;
            out.face[at] = i;
            std::copy(w, w + 3, out.weights[at]);
        }
    }
    out.depth[at] = nearest;
}

} // namespace

extern "C" void per_pixel_rasterize(const float *faces, int count, int width, int height, int threads,
                                    int32_t *face, float *depth, float *weights)
{
    const Face *const all = reinterpret_cast<const Face *>(faces);
    const Boxes boxes = boxes_of(all, count);
    const Pictures out = {width, height, face, depth, reinterpret_cast<float(*)[3]>(weights)};
    std::vector<std::thread> workers;
    for (int t = 0; t < threads; t++) {
        workers.emplace_back([=, &boxes] {
            for (int row = height * t / threads; row < height * (t + 1) / threads; row++) {
                for (int column = 0; column < width; column++) {
                    draw_pixel(all, count, boxes, column, row, out);
                }
            }
        });
    }
    for (std::thread &worker : workers) {
        worker.join();
    }
}

// Values of three corners each, weighed by pixel; 0 where no face is.
extern "C" void per_pixel_interpolate(const float *corners, int channels, int pixels, const int32_t *face,
                                      const float *weights, float *out)
{
    for (int p = 0; p < pixels; p++) {
        for (int c = 0; c < channels; c++) {
            float sum = 0;
            for (int i = 0; i < 3 && face[p] >= 0; i++) {
                sum += weights[3 * p + i] * corners[(face[p] * 3 + i) * channels + c];
            }
            out[p * channels + c] = sum;
        }
    }
}
