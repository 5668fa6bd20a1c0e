// SPDX-License-Identifier: MIT
// Files that were dropped or chosen, folders too, as a model and the files beside it.

const MODELS = [/\.(glb|gltf)$/i, /\.(obj|ply|off|stl|3mf)$/i]; // of several in a folder, the better described first
const NAMED = /\.(bin|mtl|png|jpe?g|jpe|jfif|webp|ktx2|gif|bmp|dib|tga|tiff?|dds|psd|hdr|exr|avif|p[gnp]m|sgi|rgba?|bw)$/i; // what a model may name
const USUAL = /^((textures?|tex|images|maps|materials)\/.+|[^/]+)$/i; // where most have it beside the model's folder
const MOST_BESIDE = 2 ** 28; // bytes of it that are read: a folder of downloads has more beside a model

const depthOf = (path) => path.split('/').length;
const folderOf = (path) => path.slice(0, path.lastIndexOf('/') + 1);

// A folder tells of its entries in portions, of which the last is empty.
async function entriesOf(folder) {
  const reader = folder.createReader();
  const entries = [];
  for (;;) {
    const portion = await new Promise((done, fail) => reader.readEntries(done, fail));
    if (portion.length === 0) {
      return entries;
    }
    entries.push(...portion);
  }
}

// [path, File] of everything in an entry.
async function filesOf(entry, path = '') {
  if (entry.isFile) {
    return [[path + entry.name, await new Promise((done, fail) => entry.file(done, fail))]];
  }
  const inside = await entriesOf(entry);
  return (await Promise.all(inside.map((inner) => filesOf(inner, `${path}${entry.name}/`)))).flat();
}

/** [path, File] of all that was dropped. To be called while the event is handled: its items are gone after that. */
export function droppedFiles({ items, files }) {
  const entries = [...items].filter(({ kind }) => kind === 'file').map((item) => item.webkitGetAsEntry?.());
  const areEntries = entries.length > 0 && entries.every(Boolean);
  return areEntries ? Promise.all(entries.map((entry) => filesOf(entry))).then((all) => all.flat()) : chosenFiles(files);
}

/** The same of an input. */
export const chosenFiles = async (files) => [...files].map((file) => [file.webkitRelativePath || file.name, file]);

async function read([path, file]) {
  try {
    return [path, await file.arrayBuffer()];
  } catch {
    throw new Error(path);
  }
}

/**
 * {bytes, name, files}: of several files one is the model, the others are those that it may name: all in its folder, and of those
 * beside its folder, as textures often are, what models name, 256 MiB at most. Paths count from the folder that holds the model's.
 * undefined where there is none. What cannot be read is an error whose message is its path, or is left out where it lies beside.
 */
export async function modelOf(list) {
  const kindOf = ([path]) => [...MODELS.map((kind) => kind.test(path)), true].indexOf(true);
  const [main] = [...list].sort((a, b) => kindOf(a) - kindOf(b) || depthOf(a[0]) - depthOf(b[0]));
  if (!main) {
    return undefined;
  }
  const folder = folderOf(main[0]);
  const around = folderOf(folder.slice(0, -1));
  const own = list.filter((file) => file !== main && file[0].startsWith(folder));
  const named = list.filter(([path]) => !path.startsWith(folder) && path.startsWith(around) && NAMED.test(path));
  const isUsual = ([path]) => USUAL.test(path.slice(around.length));
  let room = MOST_BESIDE;
  const beside = [...named.filter(isUsual), ...named.filter((file) => !isUsual(file))].filter(([, { size }]) => {
    const isRead = size <= room;
    room -= isRead ? size : 0;
    return isRead;
  });
  const reads = [...[main, ...own].map(read), ...beside.map((file) => read(file).catch(() => undefined))];
  const there = (await Promise.all(reads)).filter(Boolean);
  const [[name, bytes], ...files] = there.map(([path, data]) => [path.slice(around.length), data]);
  return { bytes, name, files: Object.fromEntries(files) };
}
