#version 450
layout(local_size_x = 16, local_size_y = 2) in;
layout(constant_id = 1) const int SIZE = 8;
struct Item { vec3 at; uint id; mat2x3 turn; float rest[2]; };
layout(set = 0, binding = 0, std430) buffer Items { uint total; Item items[]; };
layout(set = 0, binding = 1, std140) uniform Constants { layout(row_major) mat3 rows; vec4 list[4]; } constants;
layout(set = 0, binding = 2) buffer Sink { uint sink[]; } sinks[2];
shared uint cells[32];
shared float sums[SIZE];
shared bool flags[4];

void main()
{
    uint i = gl_LocalInvocationIndex;
    cells[i] = i * 3u;
    flags[i & 3u] = i > 7u;
    if (i < uint(SIZE)) {
        sums[i] = constants.rows[i % 3u].y + constants.list[i & 3u].x;
    }
    barrier();
    uint before = atomicAdd(total, cells[31u - i]);
    Item item = items[i % 2u];
    item.at = item.turn * item.at.xy + vec3(sums[i & 7u]);
    item.rest[i & 1u] = flags[2] ? 1.0 : before > 5u ? 0.5 : 0.25;
    items[(i + 1u) % 2u] = item;
    atomicMax(sinks[i & 1u].sink[i & 7u], before ^ i);
    sinks[1].sink[gl_WorkGroupID.x] = items.length();
}
