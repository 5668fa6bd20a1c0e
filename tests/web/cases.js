// SPDX-License-Identifier: MIT
// Pictures that the package must draw as the program does, byte for byte: the options of one, and the command line of
// the other, which are written down apart. Models are those of Debian's assimp-testmodels.
const box = 'glTF2/BoxTextured-glTF-Binary/BoxTextured.glb';

export const cases = [
    { name: 'plain', model: box, options: {}, words: [] },
    {
        name: 'options',
        model: box,
        options: {
            size: [301, 207], samples: 1, supersample: 4, orbit: [-40, 35], zoom: 1.25, margin: 10, up: 'z', fovy: 50,
            background: '4682b4', shadows: false, ambientOcclusion: false, toneMap: 'aces', exposure: -0.5,
            ground: true,
        },
        words: [
            '--size=301x207', '--samples=1', '--supersample=4', '--orbit=-40,35', '--zoom=1.25', '--margin=10',
            '--up=z', '--fovy=50', '--background=4682b4', '--shadows=off', '--ambient-occlusion=off', '--tone-map=aces',
            '--exposure=-0.5', '--ground',
        ],
    },
    {
        name: 'camera',
        model: box,
        options: {
            size: 256, camera: { eye: [1.5, 0.7, 2.1], target: [0, 0.1, 0], up: [0.2, 1, 0], fovy: 40 },
            wireframe: true, interpolate: 'noperspective', lights: 'none', transparency: 'exact',
        },
        words: [
            '--size=256', '--camera=1.5,0.7,2.1,0,0.1,0,0.2,1,0,40', '--wireframe', '--interpolate=noperspective',
            '--lights=none', '--transparency=exact',
        ],
    },
    {
        name: 'ortho',
        model: box,
        options: { size: [64, 200], ortho: true, fit: 'all', wireframe: 'plain' },
        words: ['--size=64x200', '--ortho', '--fit=all', '--wireframe=plain'],
    },
    {
        name: 'orthographic camera',
        model: box,
        options: { size: 64, camera: { eye: [1.5, 0.7, 2.1], target: [0, 0.1, 0], orthographic: true, height: 1.6 } },
        words: ['--size=64', '--ortho', '--camera=1.5,0.7,2.1,0,0.1,0,0,1,0,1.6'],
    },
    {
        name: 'large texture',
        model: 'glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb',
        options: { size: [320, 200], maxTexture: 64 },
        words: ['--size=320x200', '--max-texture=64'],
    },
    {
        name: 'draco',
        model: 'glTF2/draco/2CylinderEngine.gltf',
        files: ['2CylinderEngine.bin'],
        options: { size: [320, 200] },
        words: ['--size=320x200'],
    },
    {
        name: 'obj and its files',
        model: 'OBJ/spider.obj',
        files: [
            'spider.mtl', 'SpiderTex.jpg', 'drkwood2.jpg', 'engineflare1.jpg', 'wal67ar_small.jpg', 'wal69ar_small.jpg',
        ],
        options: { size: [400, 300], samples: 8 },
        words: ['--size=400x300', '--samples=8'],
    },
    {
        name: 'animation',
        model: 'glTF2/simple_skin/simple_skin.gltf',
        options: { size: 128, time: 0.5 },
        words: ['--size=128', '--time=0.5'],
    },
    { name: 'ply', model: 'PLY/Wuson.ply', options: { size: 200 }, words: ['--size=200'] },
    { name: 'points', model: 'PLY/points.ply', options: { size: 200 }, words: ['--size=200'] },
    { name: 'stl', model: 'STL/Spider_binary.stl', options: { size: 200 }, words: ['--size=200'] },
    { name: '3mf', model: '3MF/box.3mf', options: { size: 200 }, words: ['--size=200'] },
];

/** The pixel of `plain` that is explained. */
export const explained = { x: 600, y: 300, sample: 2 };
