#!/usr/bin/env python3
"""Makes a garden in shares on many workers, and joins the lists of places that they write.

    pip install 'dask[distributed]'
    scripts/park.py park.toml FOLDER --shards 64 --workers 4                    # workers on this machine
    scripts/park.py park.toml FOLDER --shards 640 --scheduler tcp://host:8786   # those of a cluster that sees FOLDER
    scripts/park.py park.toml FOLDER --shards 64 --join places.json             # one list of all shares

Each share is one run of `penstemon garden SPEC --shard I/N`, which needs nothing of the others. A share that is there already is
not made again, so a park that was stopped goes on where it was. Dask gives the shares of a worker that dies to others.
Other arguments after `--` go to the program: `-- --seed 7 --density 0.5`.
"""

import argparse
import os
import pathlib
import subprocess
import sys

START, END = b'"plants":[', b"\n]}\n"


def make(program, spec, share, shares, file, options):
    """Makes one share; returns what the program said. The program puts a file in its place only when it is whole."""
    if file.exists():
        return ""
    command = [program, "garden", spec, "--shard", f"{share}/{shares}", "-o", str(file), *options]
    # Workers share the cores, so each run has one.
    run = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "RAYON_NUM_THREADS": "1"})
    if run.returncode != 0:
        raise RuntimeError(f"share {share} of {shares}: {run.stderr.strip()}")
    return run.stderr


def join(files, out):
    """Writes the list of the whole garden from the lists of its shares, one in memory at a time."""
    with open(out, "wb") as whole:
        between = b""
        for file in files:
            head, _, plants = file.read_bytes().partition(START)
            plants = plants.removesuffix(END)
            if file == files[0]:
                whole.write(head + START)
            if plants:
                whole.write(between + plants)
                between = b","
        whole.write(END)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("spec", help="the garden's file (.toml)")
    arguments.add_argument("folder", type=pathlib.Path, help="where the shares go")
    arguments.add_argument("--shards", type=int, default=64, help="how many shares (64)")
    arguments.add_argument("--workers", type=int, default=os.cpu_count(), help="workers on this machine (its cores)")
    arguments.add_argument("--scheduler", help="address of a Dask scheduler instead of workers here")
    arguments.add_argument("--format", choices=["json", "glb", "obj"], default="json", help="of the shares (json)")
    arguments.add_argument("--program", default="penstemon", help="the program, as the workers find it (penstemon)")
    arguments.add_argument("--join", type=pathlib.Path, metavar="FILE", help="one list of all shares, for --format json")
    own, options = sys.argv[1:], []
    if "--" in own:
        own, options = own[: own.index("--")], own[own.index("--") + 1 :]
    given = arguments.parse_args(own)
    if given.join and given.format != "json":
        arguments.error("--join joins lists of places; leave out --format")

    from dask.distributed import Client, LocalCluster, as_completed

    given.folder.mkdir(parents=True, exist_ok=True)
    files = [given.folder / f"{share:06}.{given.format}" for share in range(1, given.shards + 1)]
    cluster = given.scheduler or LocalCluster(n_workers=given.workers, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        jobs = [
            client.submit(make, given.program, given.spec, share, given.shards, file, options, retries=2, pure=False)
            for share, file in enumerate(files, 1)
        ]
        for done, job in enumerate(as_completed(jobs), 1):
            said = job.result()
            print(f"{done} of {given.shards}", said.strip(), file=sys.stderr)
    if given.join:
        join(files, given.join)


if __name__ == "__main__":
    main()
