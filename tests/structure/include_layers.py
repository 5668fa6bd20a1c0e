#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How files of src/, shader/, vulkan/ and scene/ include each other.

(a) Rooms point down: a file includes nothing of a room above its own, or of one beside it.
(b) So do the folders of src/kernels, also by way of headers at its root, which belong to no folder.
(c) No large circle of source-and-header pairs outside of src/kernels.
(d) No long chain of includes within src/kernels.
(e) The driver in vulkan/ sees src/driver.h alone of src/.
usage: include_layers.py REPOSITORY
"""
import os
import re
import sys

# From the bottom up. Rooms of one line stand beside each other, and a file may be a room of its own. "" is the root:
# src/context_create.c and src/defaults.c know every room, and scene/model.h is known by every room. The readers at
# the root of scene/import stand beside the function that chooses one, above those with a folder of their own.
SRC = ['base', 'context', 'format', 'resource', 'pipeline', 'binding', 'draw', 'kernels', 'run', 'pass', 'dispatch recording', '']
SHADER = ['module', 'form', 'interpreter emitter', 'library']
SCENE = ['', 'draw/shading', 'draw/camera', 'import/image', 'import/builder',
         'import/finish import/gltf import/threemf import/assimp draw', 'import']
KERNELS = ['texel', 'texture', 'raster', 'depth', 'fragment geometry', 'tile']

# What rooms below src/kernels may include of it: the table of kernels, what its functions take, and texels.
KERNELS_INTERFACE = re.compile(r'kernels/(kernels|mip_work|transfer_work)\.h|kernels/texel/')

LARGEST_CIRCLE = {'src': 3, 'shader': 0, 'scene': 2}  # source-and-header pairs
LONGEST_CHAIN = 9  # files, the source at the top included


def includes_below(folder):
    """By file, the files of the folder that it includes. All are paths from there."""
    files = {os.path.relpath(os.path.join(path, name), folder)
             for path, _, names in os.walk(folder) for name in names if name.endswith(('.c', '.h', '.cc'))}
    found = {}
    for file in files:
        with open(os.path.join(folder, file), encoding='utf-8') as text:
            names = re.findall(r'^#include "(.+)"', text.read(), re.MULTILINE)
        beside = [os.path.normpath(os.path.join(os.path.dirname(file), name)) for name in names]
        found[file] = [near if near in files else name
                       for near, name in zip(beside, names) if near in files or name in files]
    return found


def room_of(file, rooms):
    """The innermost of the rooms that the file is in."""
    while file not in rooms and file:
        file = os.path.dirname(file)
    return file


def upward(includes, layers, is_allowed):
    """Lines that tell which includes run up."""
    rank = {room: height for height, line in enumerate(layers) for room in line.split() or ['']}
    for file in sorted(includes):
        room = room_of(file, rank)
        for to in includes[file]:
            other = room_of(to, rank)
            if room != other and rank[other] >= rank[room] and not is_allowed(to):
                yield f'{file} includes {to}, which is in a room above or beside'


def through_root(includes):
    """The includes of files in folders, where those of headers at the root count for whoever includes these."""
    def ends(file, seen):
        for to in includes[file]:
            if os.path.dirname(to):
                yield to
            elif to not in seen:
                yield from ends(to, seen | {to})
    return {file: sorted(set(ends(file, set()))) for file in includes if os.path.dirname(file)}


def beyond_door(folder):
    """Lines that tell which files of the driver include what is neither their own nor the door."""
    for path, _, names in os.walk(folder):
        for name in sorted(names):
            if not name.endswith(('.c', '.h')):
                continue
            with open(os.path.join(path, name), encoding='utf-8') as text:
                for to in re.findall(r'^#include "(.+)"', text.read(), re.MULTILINE):
                    is_own = any(os.path.exists(os.path.join(near, to)) for near in (path, folder))
                    if not is_own and to != 'src/driver.h' and not to.startswith('rhw/'):
                        yield f'{name} includes {to}'


def reached(start, includes):
    """All that is included by way of others."""
    found, left = set(), [start]
    while left:
        for to in includes.get(left.pop(), ()):
            if to not in found:
                found.add(to)
                left.append(to)
    return found


def largest_circle(includes):
    """Of pairs that reach each other, the most that hang together."""
    pairs = {}
    for file, to in includes.items():
        pair = os.path.splitext(file)[0]
        pairs.setdefault(pair, set()).update({os.path.splitext(name)[0] for name in to if name in includes} - {pair})
    reach = {pair: reached(pair, pairs) for pair in pairs}
    circles = ({other for other in reach[pair] if pair in reach[other]} for pair in pairs)
    return sorted(max(circles, key=len, default=set()))


def longest_chain(includes):
    """The longest chain that begins at a file; one that comes back to itself is told as such."""
    known = {}

    def chain(file, above):
        if file in above:
            sys.exit(f'{file} includes itself, by way of {" ".join(above)}')
        if file not in known:
            known[file] = [file] + max((chain(to, above + [file]) for to in includes[file]), key=len, default=[])
        return known[file]
    return max((chain(file, []) for file in sorted(includes)), key=len)


def main(root):
    src, shader, scene = (includes_below(os.path.join(root, folder)) for folder in ('src', 'shader', 'scene'))
    below = len('kernels/')
    kernels = {file[below:]: [name[below:] for name in to if name.startswith('kernels/')]
               for file, to in src.items() if file.startswith('kernels/')}
    flaws = [f'src/{line}' for line in upward(src, SRC, KERNELS_INTERFACE.match)]
    flaws += [f'shader/{line}' for line in upward(shader, SHADER, lambda to: False)]
    flaws += [f'scene/{line}' for line in upward(scene, SCENE, lambda to: False)]
    flaws += [f'src/kernels/{line}' for line in upward(through_root(kernels), KERNELS, lambda to: False)]
    outside = {file: to for file, to in src.items() if not file.startswith('kernels/')}
    for folder, includes in (('src', outside), ('shader', shader), ('scene', scene)):
        circle = largest_circle(includes)
        print(f'{folder}: the largest circle has {len(circle)} of at most {LARGEST_CIRCLE[folder]} pairs')
        if len(circle) > LARGEST_CIRCLE[folder]:
            flaws.append(f'{folder}: a circle of {len(circle)} source-and-header pairs: {" ".join(circle)}')
    flaws += [f'vulkan/{line}' for line in beyond_door(os.path.join(root, 'vulkan'))]
    chain = longest_chain(kernels)
    print(f'src/kernels: the longest chain has {len(chain)} of at most {LONGEST_CHAIN} files')
    if len(chain) > LONGEST_CHAIN:
        flaws.append(f'src/kernels: a chain of {len(chain)} files: {" ".join(chain)}')
    for flaw in flaws:
        print(flaw, file=sys.stderr)
    return 1 if flaws else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1]))
