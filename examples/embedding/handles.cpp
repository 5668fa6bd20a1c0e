// SPDX-License-Identifier: MIT
// The cube with the owners of handles.hpp: textures that move into a vector, and an allocation that fails. Prints a
// number made of each picture, and what the exception said.
#include <cstdio>
#include <vector>

#include "handles.hpp"

#include "cube.h"
#include "picture_hash.h"

static handles::texture make_picture(const handles::context &context, int size)
{
    rhw_texture_def def = {};
    def.format = RHW_FORMAT_RGBA8_SRGB;
    def.width = def.height = size;
    return handles::texture(context, def);
}

static void draw()
{
    const handles::context context = handles::make_context();
    const handles::pipeline pipeline(context, cube_pipeline_def());
    std::vector<handles::texture> pictures;
    for (int size : {100, 200, 300}) {
        pictures.push_back(make_picture(context, size));
    }
    for (const handles::texture &picture : pictures) {
        handles::must(cube_draw(context.get(), pipeline.id(), picture.id(), 0.5f));
        std::printf("%016llx\n", static_cast<unsigned long long>(hash_picture(context.get(), picture.id())));
    }
}

static void fail()
{
    rhw_context_def def = {};
    def.allocator.allocate = [](void *, size_t, size_t) -> void * { return nullptr; };
    def.allocator.release = [](void *, void *, size_t) {};
    handles::make_context(def);
}

int main()
{
    try {
        draw();
        fail();
    } catch (const std::exception &error) {
        std::printf("%s\n", error.what());
    }
}
