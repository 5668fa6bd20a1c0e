// SPDX-License-Identifier: MIT

/**
 * rhw draws 3D models on the CPU, byte for byte as the program `rhw` does it on any machine, and tells of every pixel
 * how it got its value.
 *
 * Everything runs where it is called and takes its time: in a page, call it in a worker.
 *
 * What goes wrong is an {@link RhwError}, whose message is one line that names the thing and the rule: `rhw: samples:
 * '3' is not 1, 2, 4, 8 or 16`. Functions that return promises reject with it, the
 * methods of a {@link Scene} throw it.
 *
 * @packageDocumentation
 */

/** What rhw tells when something goes wrong. */
export class RhwError extends Error {
    readonly name: 'RhwError';
}

/** The bytes of a file. */
export type Bytes = ArrayBuffer | ArrayBufferView;

// The arrays that pictures are in: on memory of their own, as `ImageData` and `Blob` want it. Compilers before TypeScript 5.7
// know no other.
type Color8 = ReturnType<Uint8ClampedArrayConstructor['from']>;
type Numbers32 = ReturnType<Uint32ArrayConstructor['from']>;
type Floats32 = ReturnType<Float32ArrayConstructor['from']>;
type Floats64 = ReturnType<Float64ArrayConstructor['from']>;

/**
 * A model: the bytes of its file, or its address, from which the files that it names are fetched too. An address is relative to
 * the page or, in node, to the folder of the process.
 */
export type Source = Bytes | string | URL;

/** Three numbers: a place or a direction in the world of the model. */
export type Vector = readonly [x: number, y: number, z: number];

// Reading ---------------------------------------------------------------------------------------------------------

/** How a model file is read. */
export interface LoadOptions {
    /**
     * What the file is called. Its ending tells the format where its content does not, and messages name it. Without
     * a name the format is told from the content alone, which suffices for .glb, .gltf, .ply, .off, .stl, .3mf and most
     * .obj.
     */
    name?: string;
    /**
     * The files beside it that it names, textures, buffers and .mtl files, by their paths as seen from the model:
     * `{ 'box.mtl': …, 'textures/wood.png': … }`. What is missing is warned of, and drawn in magenta.
     */
    files?: Readonly<Record<string, Bytes>>;
    /** The materials of this name, of a glTF that offers a choice; see {@link ModelInfo.variants}. */
    variant?: string;
    /** Which animation, by its name or number; see {@link ModelInfo.animations}. The default is the first. */
    animation?: string | number;
    /** Seconds: the model as its animation has it then. Without it the model is at rest. */
    time?: number;
    /**
     * Textures are halved until neither side is longer, 1 to 16384 texels. {@link load} leaves them as they are;
     * {@link render} chooses by the size of the picture, as the program does.
     */
    maxTexture?: number;
    /** Fail where the file has something that is not drawn as it is meant, instead of a warning. */
    strict?: boolean;
    /**
     * Threads to draw with. The default is one for each core, and a greater number means that: in node and its
     * workers, and in a page that is [cross-origin
     * isolated](https://developer.mozilla.org/docs/Web/API/Window/crossOriginIsolated) and its workers; elsewhere it is
     * always 1. The picture is the same. With several, a scene takes longer to open.
     */
    threads?: number;
    /**
     * Gives up, and rejects with the reason of the signal: what is fetched, at once; what is read or drawn, when that is done.
     */
    signal?: AbortSignal;
}

/**
 * Reads a model: glTF 2.0 (.glb, and .gltf with its files; Draco, meshopt, WebP and KTX2 included), OBJ, PLY, OFF, STL
 * or 3MF. A file that makes the reader crash does no harm to anything else.
 *
 * @param model the bytes of the file, which are copied, or its address
 * @returns a scene, to be drawn as often as one likes
 */
export function load(model: Source, options?: LoadOptions): Promise<Scene>;

// Pictures --------------------------------------------------------------------------------------------------------

/** Pictures of several kinds can be drawn at a time. Rows run from top to bottom, pixels from left to right. */
export interface Outputs {
    /** RGBA, sRGB encoded, alpha not multiplied in: what `ImageData` takes. */
    color: Color8;
    /** RGBA of light before tone mapping, linear, premultiplied, without the background. */
    linear: Floats32;
    /** 0 at the near plane to 1 at the far plane, linear on the screen; 1 where nothing is. */
    depth: Floats32;
    /** Along the view, in the units of the model; `Infinity` where nothing is. */
    distance: Floats32;
    /** x, y, z in the world, of length 1, turned to the viewer, then 1; four zeros where nothing is. */
    normal: Floats32;
    /**
     * x, y, z in the world, then 1; four zeros where nothing is. In double where the model, or a part
     * that the camera is near, stands over 256 times its size away from the origin.
     */
    position: Floats32 | Floats64;
    /** u, v of the first set, 0, then 1; four zeros where nothing is. v runs down. */
    uv: Floats32;
    /** The number of the node that is seen, from 1; 0 where nothing is. */
    object: Numbers32;
    /** 1 + the number of the triangle, line or point that is seen; 0 where nothing is. */
    triangle: Numbers32;
    /** a, b, c: the weights of the three vertices in space, then 1; four zeros where nothing is. */
    barycentric: Floats32;
    /** How many surfaces lie above each other at the centre of the pixel, seen or not. */
    overdraw: Floats32;
    /** How many triangles the pixel's tile has: where the work is. */
    tiles: Numbers32;
    /**
     * How the model was drawn in that tile: 1 in order, 2 depth first, 4 from the last triangle on, or several of them
     * added up; 0 where none of it is.
     */
    plan: Numbers32;
}

/** The name of an output. */
export type OutputName = keyof Outputs;

/** From where to where: the numbers of an option `--camera`. */
export interface Camera {
    eye: Vector;
    target: Vector;
    /** Which way is up in the picture; not along the view. The default is `[0, 1, 0]`. */
    up?: Vector;
    /** The whole angle of view from the bottom to the top of the picture, degrees, 0.01 to 179. The default is 30. */
    fovy?: number;
    /** `fovy` by another name. */
    fov?: number;
    /** Without perspective: `height` says then how much is seen, not `fovy`. */
    orthographic?: boolean;
    /** Of the whole picture in the world; of an orthographic camera. */
    height?: number;
}

/** The camera that a picture was drawn with. It can be given back as a {@link Camera}. */
export interface ViewCamera {
    eye: [number, number, number];
    target: [number, number, number];
    up: [number, number, number];
    /** Degrees; absent in an orthographic view. */
    fovy?: number;
    /** Present in a view without perspective. */
    orthographic?: true;
    /** Of the whole picture in the world; of an orthographic view. */
    height?: number;
    /** Distances of the planes that enclose the model; `far` may be `Infinity`. */
    near: number;
    far: number;
}

/** Which view is drawn, and how: options of `rhw render` by their names there. */
export interface RenderOptions {
    /** Pixels, each way 1 to 16384; one number for a square. The default is `[1280, 720]`. */
    size?: number | readonly [width: number, height: number];
    /** Samples of each pixel, for smooth edges. The default is 4. Data outputs are never smoothed. */
    samples?: 1 | 2 | 4 | 8 | 16;
    /** Pixels drawn and shaded for each one of the picture. The default is 1. */
    supersample?: 1 | 4 | 9 | 16;
    /**
     * A camera, or one of the file by its number or name. Without it, {@link RenderOptions.orbit} and
     * {@link RenderOptions.fit} the file's first camera is taken; where there is none, or the model is nothing but a
     * dot in it, the model is fitted into the picture.
     */
    camera?: Camera | number | string;
    /**
     * Fit the model from these angles, degrees: azimuth 0 is its front, 90 its right side; elevation 90 looks
     * straight down and is 20 where it is left out. The default is `[30, 20]`.
     */
    orbit?: number | readonly [azimuth: number, elevation: number];
    /**
     * Fit the model, also where the file has cameras: its subject (`true`), without a ground that would make it a
     * dot, or all.
     */
    fit?: boolean | 'subject' | 'all';
    /** What is up in the world. The default is what the file says. */
    up?: 'x' | 'y' | 'z' | '-x' | '-y' | '-z';
    /** Larger than it is fitted, or below 1 smaller; 0.01 to 100. */
    zoom?: number;
    /** Percent of the picture left free on each side of a fitted model, 0 to 45. The default is 4. */
    margin?: number;
    /** Fit without perspective. */
    ortho?: boolean;
    /** The vertical angle of view of a fitted camera, degrees. The default is 30. */
    fovy?: number;
    /** `fovy` by another name. */
    fov?: number;
    /** `noperspective` shows what is wrong with values that are mixed on the screen. */
    interpolate?: 'smooth' | 'noperspective';
    /** Edges over the shaded surface (`true`, `over`) or over a plain one. */
    wireframe?: boolean | 'over' | 'plain';
    /**
     * A colour as style sheets write it: `#f80`, `#ff8800`, `rgb(255 136 0)`, `hsl(32 100% 50%)`, `darkorange`; or as a number,
     * `0xff8800`; `transparent`; or `default`, a soft gradient.
     */
    background?: string | number;
    /** Those of the file, if it has any; the default ones; or none but the surroundings. */
    lights?: 'file' | 'default' | 'none';
    /** Of the lights. The default is `true`. */
    shadows?: boolean;
    /** Let the model cast a soft shadow on a ground that does not show otherwise. */
    ground?: boolean;
    /** Darken where things stand close together. The default is `true`. */
    ambientOcclusion?: boolean;
    /** How light becomes colours. The default is `neutral`. */
    toneMap?: 'neutral' | 'aces' | 'agx' | 'none';
    /**
     * Transparent surfaces by the middles of their triangles (the default), or in every sample by their depth
     * there.
     */
    transparency?: 'sorted' | 'exact';
    /** Brighter by this many factors of two, -20 to 20. */
    exposure?: number;
    /**
     * A fragment shader in SPIR-V that shades the model instead of its materials. What it reads and writes is that of
     * `rhw render --fragment-shader`; `rhw shader mine.frag -o mine.spv` and `glslangValidator -V` make it of GLSL.
     */
    fragmentShader?: ArrayBuffer | ArrayBufferView;
    /**
     * Asked all the while that a picture is drawn, hundreds of times a second; `false` gives it up within a few
     * milliseconds, which is an {@link RhwError}. The scene can draw again. A worker that draws hears no message
     * meanwhile; it may look into shared memory here.
     */
    goesOn?: () => boolean;
    /** What was aborted before is not drawn: the reason of the signal is thrown. {@link RenderOptions.goesOn} ends a picture. */
    signal?: AbortSignal;
}

/** What is drawn in one go: the pictures that were asked for, and the view. */
export type Picture<Name extends OutputName = 'color'> = Pick<Outputs, Name> & {
    width: number;
    height: number;
    camera: ViewCamera;
    /** That drew it. */
    threads: number;
    /** Lines that the program would print as warnings. */
    warnings: string[];
};

/**
 * Reads a model and draws it: the bytes of `rhw render` with the same options.
 *
 * @param model the bytes of the file or its address, see {@link load}
 * @param options with `outputs`, the pictures that are wanted; the default is `['color']`
 */
export function render<Name extends OutputName = 'color'>(
    model: Source,
    options?: LoadOptions & RenderOptions & { outputs?: readonly Name[] },
): Promise<Picture<Name>>;

/**
 * A model in memory of its own, which {@link load} makes. Its methods do their work at once; they throw {@link
 * RhwError}.
 */
export class Scene {
    private constructor();
    /** What the file has that is not drawn as it is meant, a line each. */
    readonly warnings: string[];
    /** What is in the file. */
    info(): ModelInfo;
    /**
     * The view that {@link Scene.render} would draw, without drawing it: where a fitted camera stands, to go on
     * from there.
     */
    view(options?: RenderOptions): { width: number; height: number; camera: ViewCamera };
    /** Draws a view. Nothing of the model is taken in again, so a control may call it frame after frame. */
    render<Name extends OutputName = 'color'>(
        options?: RenderOptions & { outputs?: readonly Name[] },
    ): Picture<Name>;
    /**
     * Tells how a pixel got its value: every fragment that came to it, and of the one that is seen the whole
     * derivation, in exact arithmetic beside what the pipeline computed.
     *
     * @param x from the left, 0 to width − 1
     * @param y from the top, 0 to height − 1
     * @param options those the picture was drawn with, without exact `transparency`; and which of the pixel's samples, 0
     *   where that is left out; with `supersample` those of each pixel that is drawn follow those of the one before
     */
    explain(x: number, y: number, options?: RenderOptions & { sample?: number }): Explanation;
    /** Ends the scene's threads and gives its memory back. It cannot be used after that. */
    close(): void;
}

// What is told ----------------------------------------------------------------------------------------------------

/** What `rhw info --json` prints. Numbers that are not finite are `null`. */
export interface ModelInfo {
    file: string;
    /** For example `glTF 2.0`. */
    format: string;
    triangles_drawn: number;
    triangles_stored: number;
    objects: number;
    draws: number;
    /** Where the model is drawn from, in the coordinates of the file: zeros unless it is far from their origin. */
    origin: [x: number, y: number, z: number];
    bounds: { empty: true } | { empty: false; min: [number, number, number]; max: [number, number, number] };
    /** What a fitted picture is about: the bounds without what nobody can see, and without specks far away. */
    frame: { empty: true } | { empty: false; min: [number, number, number]; max: [number, number, number] };
    /** Of lengths, for example `metre`; empty where the file does not say. */
    unit: string;
    up: 'x' | 'y' | 'z' | '-x' | '-y' | '-z';
    up_from: 'shape' | 'format';
    mesh_bytes: number;
    texture_bytes: number;
    meshes: {
        name: string;
        primitive: 'triangles' | 'lines' | 'points';
        count: number;
        vertices: number;
        material: number;
        normals: boolean;
        tangents: boolean;
        uv0: boolean;
        uv1: boolean;
        colors: boolean;
    }[];
    materials: ({
        name: string;
        base_color: [number, number, number, number];
        metallic: number;
        roughness: number;
        emissive: [number, number, number];
        alpha_mode: 'opaque' | 'mask' | 'blend';
        alpha_cutoff: number;
        unlit: boolean;
        double_sided: boolean;
    } & Record<string, unknown>)[];
    images: {
        name: string;
        width: number;
        height: number;
        type: 'RGBA8' | 'RGBA16' | 'RGBA32F';
        alpha: boolean;
        missing: boolean;
        color: boolean;
        data: boolean;
    }[];
    cameras: ({ name: string; type: 'orthographic' | 'perspective' } & Record<string, unknown>)[];
    lights: ({ name: string; type: 'directional' | 'point' | 'spot' } & Record<string, unknown>)[];
    animations: { name: string; seconds: number; channels: number }[];
    extensions: { name: string; required: boolean; drawn: boolean }[];
    variants: string[];
    warnings: string[];
    unsupported: string[];
}

/** Three numbers, one for each vertex. */
export type Triple = [number, number, number];

/** How a coordinate goes on beyond 0..1. */
export type ExplainedAddress = 'repeat' | 'mirror' | 'clamp' | 'border' | 'mirror once';

/** A fragment that came to the sample. The notation is that of rhw's docs/exactness.md. */
export interface ExplainedFragment {
    /** The draw of the pass, from 0. */
    draw: number;
    /** The instance of the model; -1 the background, -2 the ground. */
    instance: number;
    /** The name of its node. */
    node: string;
    /** In its draw, from 0. */
    triangle: number;
    front_facing: boolean;
    fate: 'failed_early' | 'discarded' | 'failed_late' | 'written';
    /** The samples of the pixel that it covers, a bit each. */
    covered: number;
    /** 1 near to 0 far: reversed. */
    depth: number;
    depth_before_after: [number, number];
    color_before: [number, number, number, number];
    color_after: [number, number, number, number];
    /** What its shader gave, where that ran. */
    output?: [number, number, number, number];
    /** X, Y, Z, W of the vertices. */
    clip: [number, number, number, number][];
    clipped: boolean;
    /** Where the vertices were snapped to, 1/256 pixel; absent where one cannot be. */
    snapped?: [number, number][];
    /** Where the sample lies, in 1/256 pixel from the top left of what is drawn. */
    sample: [number, number];
    /** Where values are taken, in whole pixels from there, with fractions: the middle of the pixel, mostly. What follows is of there. */
    at?: [number, number];
    /** r, s, t: the weights on the screen; with `inverse_w`, 1/W, and `space`, a, b, c, where its shader ran. */
    screen?: Triple;
    inverse_w?: [number];
    space?: Triple;
    /** Those that its shader read; empty where that did not run. */
    textures: {
        /** What it is for. */
        slot: 'base color' | 'metallic-roughness' | 'normal map' | 'occlusion' | 'emission' | 'a layer';
        /** Of the mip levels: the whole part is the finer one that was read, the fraction the share of the next. */
        level: number;
        /** Texels of the finer one, and of level 0. */
        level_size: [number, number];
        base_size: [number, number];
        /** The level of detail, log2 of the longer step in texels of level 0, before the levels there are bound it. */
        lod: number | null;
        uv: [number, number];
        /** What u and v are more by at the pixel on the right, and at the one below. */
        uv_dx: [number | null, number | null];
        uv_dy: [number | null, number | null];
        /** u and v in texels of the level, from the middle of the first: times its size, less a half. */
        place: [number, number];
        /** How u and v go on beyond 0..1. Absent, as are `inside` and `filter`, where no material says it. */
        address?: [ExplainedAddress, ExplainedAddress];
        /** `place` where those have brought it: of a whole number i on, less than i + 1, texels i and i + 1 are read. */
        inside?: [number, number];
        /** `linear` mixes the four texels, `nearest` takes one. */
        filter?: 'linear' | 'nearest';
        /** What was read: red, green, blue, alpha, linear. */
        texel: [number, number, number, number];
        /** The four around the place, top left, top right, below, of this level and, by its fraction, of the next. */
        texels: [number, number, number, number][][];
    }[];
    /** What the built-in shader makes of the lights there; null for a surface without any, the background, and a fragment that was not shaded. */
    light: {
        /** A normal map has turned the normal. */
        normal_mapped: boolean;
        normal: Triple;
        /** The part of the light from all around that ambient occlusion lets through, 0 to 1. */
        ambient_open: number;
        /** The first 8; `sum` is what arrives of all of them. */
        lights: {
            type: 'directional' | 'point' | 'spot';
            /** Below 0 the surface faces away. */
            n_dot_l: number;
            /** Unit, towards the light. */
            direction: Triple;
            /** Without shadows `open` is 1. */
            has_shadows: boolean;
            /** The part that no shadow takes, 0 to 1. */
            open: number;
            /** What a white surface that faces the light sends on. */
            facing: Triple;
            /** Of that: times n_dot_l, where above 0, and times open. */
            arrives: Triple;
        }[];
        sum: Triple;
    } | null;
    /** The edge functions and their sum, 1/65536 pixel², and what follows from them in exact arithmetic. */
    edges?: Triple;
    sum?: number;
    screen_exact?: Triple;
    inverse_w_exact?: [number];
    space_exact?: Triple;
    /**
     * Every component of every varying: at the vertices, as if mixed on the screen, exact, and as the pipeline
     * wrote it.
     */
    varyings?: {
        name: string;
        vertices: Triple;
        naive: number | null;
        exact: number | null;
        pipeline: number | null;
        error_ulp: number | null;
    }[];
}

/** What `rhw explain --json` prints, and as `text` what it prints without: a worked example to read. */
export interface Explanation {
    model: string;
    size: [width: number, height: number];
    pixel: [x: number, y: number];
    /** Which of the samples of the pixel that is drawn, and how many it has. */
    sample: number;
    samples: number;
    /** Seen without perspective: every W is 1, and a, b, c are r, s, t. */
    orthographic: boolean;
    /** Of a model far from the origin of its file: what the varying `position` counts from. */
    origin?: [x: number, y: number, z: number];
    /** With `supersample`: the pixels that are drawn, and which of them is told about; places of fragments are theirs. */
    drawn_size?: [width: number, height: number];
    drawn_pixel?: [x: number, y: number];
    /** `#rrggbb`: the pixel in the picture. */
    color: string;
    /** In the order of drawing; the background is one of them. */
    fragments: ExplainedFragment[];
    /** Where nothing of the model is seen: the nearest pixel that shows it; absent where no pixel does. */
    nearest?: [x: number, y: number];
    text: string;
}

// Triangles without a model ---------------------------------------------------------------------------------------

/** Triangles to be rasterized, and where to. */
export interface Triangles {
    /** Pixels, each way 1 to 16384; one number for a square. */
    size: number | readonly [width: number, height: number];
    /**
     * The vertices, one after the other: X, Y, Z, W in homogeneous clip coordinates, y up; with `components: 3` x, y,
     * z, and W is 1. What lies outside −W ≤ X, Y ≤ W, 0 ≤ Z ≤ W is cut off; W ≤ 0 is allowed. A triangle with a
     * number that is not finite is not drawn.
     */
    positions: Float32Array;
    components?: 3 | 4;
    /**
     * Three for each triangle, each below the number of vertices. Without them the vertices are taken in their
     * order.
     */
    indices?: Uint32Array;
    /** 16 numbers, column by column, from the positions to clip coordinates. Without it they are such. */
    matrix?: Float32Array;
    /**
     * Triangles that are left out: those whose vertices run clockwise on the screen are back faces. The default is
     * `none`.
     */
    cull?: 'none' | 'front' | 'back';
    /** Of the depth that is in view, after the division by W: WebGPU's and Vulkan's (the default), or OpenGL's. */
    depthRange?: 'zero-to-one' | 'minus-one-to-one';
    /** At most; the default is all that `Picture.threads` may have. The result does not depend on it. */
    threads?: number;
}

/** What is nearest at the centre of every pixel, rows from top to bottom. */
export interface Fragments {
    width: number;
    height: number;
    /** 1 + the number of the triangle; 0 where there is none. [height × width] */
    ids: Numbers32;
    /** 0 near to 1 far; 1 where there is none. [height × width] */
    depth: Floats32;
    /**
     * a, b, c: the weights of its vertices in space, right in perspective, then 0; zeros where there is none.
     * [height × width × 4]
     */
    barycentric: Floats32;
    /** That drew. */
    threads: number;
}

/**
 * Rasterizes triangles without a model: which one is nearest at every pixel, how deep, and where on it. Coverage is
 * exact: a pixel on an edge that two triangles share belongs to exactly one of them.
 */
export function rasterize(triangles: Triangles): Promise<Fragments>;
