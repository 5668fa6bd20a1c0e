# SPDX-License-Identifier: MIT
"""Pictures of models from many places, for those who train on them: a program.

    python -m rhw.dataset chair.glb lamp.glb --views 48 --outputs color,distance,object --out chairs

draws each model from 48 places on a sphere and writes chairs/MODEL/0000.png, 0000.exr and so on, and, when all are there,
chairs/manifest.json: cameras, lenses, names of objects, and the hash of every file. A run that was ended goes on with the
same command. The same files come of it on every machine and with any number of threads, on one machine, on those of a Dask
scheduler or of a Slurm array: docs/dataset.md, and `python -m rhw.dataset --help`.
"""
