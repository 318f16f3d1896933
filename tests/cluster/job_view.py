#!/usr/bin/env python3
"""What a job folder of `atlasgauge corpus` holds, told without the program.

  job_view.py missing JOB                    paths of the models without a result, in manifest order
  job_view.py missing_slices JOB             their slices, each once
  job_view.py hold JOB COUNT                 stops so many tasks in the midst of their work, each on
                                             another node; prints slice, pid and node of each
  job_view.py check JOB CORPUS REPORTS       complains where results, tables and reports disagree
"""
import csv
import glob
import json
import os
import signal
import sys
import time
from collections import namedtuple

Model = namedtuple("Model", "slice digest path")


def unescaped(text):
    return text.replace("\\\\", "\0").replace("\\t", "\t").replace("\\n", "\n").replace("\0", "\\")


def manifest(job):
    with open(f"{job}/manifest.tsv", encoding="utf-8", errors="surrogateescape", newline="\n") as lines:
        for line in lines:
            if not line.startswith("#"):
                slice_, _, _, _, digest, path = line.rstrip("\n").split("\t")
                yield Model(int(slice_), digest, unescaped(path))


def results(job, model):
    return glob.glob(f"{job}/results/??/{model.digest}-*.result")


def missing(job):
    return [model for model in manifest(job) if not results(job, model)]


def print_missing(job):
    for model in missing(job):
        print(model.path)


def print_missing_slices(job):
    for slice_ in sorted({model.slice for model in missing(job)}):
        print(slice_)


def read(path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError:
        return b""


def parent(pid):
    fields = read(f"/proc/{pid}/stat").rpartition(b") ")[2].split()
    return fields[1].decode() if fields else ""


def task_processes(job):
    """The slice of every process `... corpus run JOB --slice I`, by pid."""
    found = {}
    for pid in filter(str.isdigit, os.listdir("/proc")):
        words = os.fsdecode(read(f"/proc/{pid}/cmdline")).replace("--slice=", "--slice\0").split("\0")
        if "corpus" in words and "run" in words and job in words and "--slice" in words:
            found[pid] = int(words[words.index("--slice") + 1])
    return found


def node_of(pid):
    for variable in read(f"/proc/{pid}/environ").split(b"\0"):
        if variable.startswith(b"SLURMD_NODENAME="):
            return variable.partition(b"=")[2].decode()
    return ""


def is_in_the_midst(job, models):
    """Something is finished, and more is not than the few models that the task may be at."""
    finished = sum(bool(results(job, model)) for model in models)
    return finished >= 1 and len(models) - finished >= 4


def send(pid, signal_):
    try:
        os.kill(int(pid), signal_)
    except ProcessLookupError:
        pass  # then it has nothing more to do, which the next look tells


def hold(job, count):
    models = {}
    for model in manifest(job):
        models.setdefault(model.slice, []).append(model)
    held = {}
    deadline = time.monotonic() + 60
    while len(held) < int(count):
        found = task_processes(job)
        for pid, slice_ in found.items():
            node = node_of(pid)
            # What a task forked for one model looks like the task itself.
            if not node or node in held or parent(pid) in found or not is_in_the_midst(job, models[slice_]):
                continue
            send(pid, signal.SIGSTOP)
            if is_in_the_midst(job, models[slice_]):
                held[node] = f"{slice_} {pid} {node}"
                break
            send(pid, signal.SIGCONT)
        if time.monotonic() > deadline:
            print(f"only {len(held)} tasks in the midst of their work within 60 s", file=sys.stderr)
            return 1
        time.sleep(0.005)
    print("\n".join(held.values()))
    return 0


complaints = []


def expect(what, expected, found):
    if expected != found:
        complaints.append(f"{what}: expected {expected!r}, found {found!r}")


def texts(value):
    if isinstance(value, dict):
        return {text for item in value.values() for text in texts(item)}
    if isinstance(value, list):
        return {text for item in value for text in texts(item)}
    return {value} if isinstance(value, str) else set()


def check_results(job, models):
    digests = {model.digest for model in models}
    for model in models:
        expect(f"results of {model.path}", 1, len(results(job, model)))
    files = [os.path.join(top, name) for top, _, names in os.walk(f"{job}/results") for name in names]
    expect("files in results", len(digests), len(files))
    expect("files in results that are none", [], [file for file in files if not file.endswith(".result")])


def check_row(corpus, model, row):
    path, name = model.path, os.path.basename(model.path)
    if path.startswith("bad/"):
        expect(f"status of {path}", "failed" if name.startswith("fails") else "measured", row["status"])
    if path.startswith("RWT"):
        expect(f"status of {path}", "measured", row["status"])
    if row["status"] == "failed" and not row.get("reason"):
        complaints.append(f"{path} failed without a reason")
    try:
        with open(os.path.join(corpus, os.path.dirname(path), "metadata.json"), encoding="utf-8") as file:
            metadata = json.load(file)
    except (OSError, ValueError):
        return
    expect(f"metadata of {path} that its row lacks", set(), texts(metadata) - texts(row))


def check_report(job, reports, model, row):
    file = os.path.join(reports, model.path + ".json")
    expect(f"a report of {model.path}", row["status"] == "measured", os.path.exists(file))
    if row["status"] == "measured":
        head, _, report = read(results(job, model)[0]).partition(b"\n")
        expect(f"status in the result of {model.path}", "measured", json.loads(head)["status"])
        expect(f"the report of {model.path} is that of its result", True, report == read(file))


def check(job, corpus, reports):
    models = list(manifest(job))
    paths = [model.path for model in models]
    expect("order of the manifest", sorted(paths, key=os.fsencode), paths)
    expect("models RWT*", 200, sum(path.startswith("RWT") for path in paths))
    check_results(job, models)
    with open(f"{job}/corpus.jsonl", encoding="utf-8", errors="surrogateescape", newline="\n") as lines:
        rows = [json.loads(line) for line in lines]
    with open(f"{job}/corpus.csv", encoding="utf-8", errors="surrogateescape", newline="") as lines:
        table = list(csv.DictReader(lines))
    expect("models of corpus.jsonl", paths, [row["model"] for row in rows])
    expect("models of corpus.csv", paths, [row["model"] for row in table])
    expect("status in both tables", [row["status"] for row in rows], [row["status"] for row in table])
    for model, row in zip(models, rows):
        check_row(corpus, model, row)
        check_report(job, reports, model, row)
    for complaint in complaints[:20]:
        print(complaint[:1000])
    failed = sum(row["status"] == "failed" for row in rows)
    print(f"{len(models)} models, {len(models) - failed} measured, {failed} failed,"
          f" {len(complaints)} complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    commands = {"missing": print_missing, "missing_slices": print_missing_slices,
                "hold": hold, "check": check}
    sys.exit(commands[sys.argv[1]](*sys.argv[2:]))
