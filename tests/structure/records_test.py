"""records_test.py REPOSITORY: figures are not older than they say. Each record of measurements names the commit that it was taken
at; where more than MOST_COMMITS commits have changed engine, shaders or preprocess since, or files differed from it ("-dirty"), a page
that publishes the record must say "of COMMIT". Each finding is one line on stderr. First it shows, on made-up repositories, that
each rule can fail. Exit code 77 where the history is not there to be compared with."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

# Records, and the page that publishes what they hold; None: the record is that page.
RECORDS = {
    "tests/bench/results/*.md": "tests/bench/README.md",
    "tests/bench/results/*.json": "tests/bench/README.md",
    "tests/hard/README.md": None,
    "tests/hard/cross_device.md": None,
    "data/figures/README.md": None,
}
MEASURED = ("engine", "shaders", "preprocess")
MOST_COMMITS = 30
SKIPPED = 77
COMMIT = r"\b([0-9a-f]{7,40}(?:-dirty)?)\b"


def git(root, *arguments):
    """What git says; None where it refuses."""
    result = subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True)
    return result.stdout.strip() if result.returncode == 0 else None


def commits_of(path):
    """The commits that a page, or a list of records, names; None stands for a page or a record that names none."""
    text = path.read_text()
    if path.suffix == ".json":
        return {record.get("commit") for record in json.loads(text)}
    return set(re.findall(rf"\b(?:of|commit)\s+{COMMIT}", text)) or {None}


def said_on(page):
    """The commits that a page says its figures are of."""
    return re.findall(rf"\bof\s+(?:commit\s+)?{COMMIT}", page.read_text()) if page.exists() else []


def is_said(commit, said):
    """Whether `said` holds the commit, clean or dirty as it is; 7 digits identify a commit."""
    return any(one[:7] == commit[:7] and one.endswith("-dirty") == commit.endswith("-dirty") for one in said)


def finding(root, name, page, commit, most):
    """What is wrong with a record's commit; None where nothing is."""
    if commit is None:
        return f"{name}: found no commit, expected the one that each figure was taken at"
    bare = commit.removesuffix("-dirty")
    if git(root, "merge-base", "--is-ancestor", bare, "HEAD") is None:
        return f"{name}: found commit {commit}, expected one of this branch's history"
    since = int(git(root, "rev-list", "--count", f"{bare}..HEAD", "--", *MEASURED))
    old = since > most or commit.endswith("-dirty")
    if old and not is_said(commit, said_on(root / page)):
        return (f"{name}: is of commit {commit}, {since} commits of {', '.join(MEASURED)} ago, expected 'of {commit}' in {page}, "
                f"or a record at most {most} such commits old")
    return None


def findings(root, most=MOST_COMMITS):
    for pattern, page in RECORDS.items():
        for path in sorted(root.glob(pattern)):
            name = str(path.relative_to(root))
            for commit in sorted(commits_of(path), key=str):
                found = finding(root, name, page or name, commit, most)
                if found:
                    yield found


def made_up_repository(folder):
    """One with two commits of the engine and one of a test; returns the first of the former."""
    author = ("-c", "user.name=none", "-c", "user.email=none@localhost", "-c", "commit.gpgsign=false")
    git(folder, "init", "--quiet")
    for name in ("engine/a", "engine/b", "tests/c"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).touch()
        git(folder, "add", name)
        git(folder, *author, "commit", "--quiet", "--message", name)
    return git(folder, "rev-list", "--max-parents=0", "HEAD")


def prove():
    """Each rule notices the one thing that it forbids, and lets pass what it allows. OLD is a commit with one of the engine since."""
    hard, runs, page = "tests/hard/README.md", "tests/bench/results/runs.json", "tests/bench/README.md"
    cases = {  # texts, most commits, findings
        "old, not said": ({hard: "commit OLD"}, 0, 1),
        "old, said": ({hard: "of commit OLD"}, 0, 0),
        "young enough": ({hard: "commit OLD"}, 1, 0),
        "not clean": ({hard: "commit OLD-dirty"}, 1, 1),
        "not clean, named as clean": ({runs: '[{"commit": "OLD-dirty"}]', page: "of OLD"}, 1, 1),
        "not clean, said": ({runs: '[{"commit": "OLD-dirty"}]', page: "of OLD-dirty"}, 1, 0),
        "old, another said": ({runs: '[{"commit": "OLD"}]', page: "of 0123456"}, 0, 1),
        "old, said elsewhere": ({runs: '[{"commit": "OLD"}]', page: "of OLD"}, 0, 0),
        "unknown": ({hard: "of commit 0123456789ab"}, 1, 1),
        "no commit": ({hard: "yesterday"}, 1, 1),
        "one without": ({runs: '[{"commit": "OLD"}, {}]'}, 1, 1),
    }
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        old = made_up_repository(folder)
        for rule, (texts, most, wanted) in cases.items():
            for file, text in texts.items():
                (folder / file).parent.mkdir(parents=True, exist_ok=True)
                (folder / file).write_text(text.replace("OLD", old[:10]))
            found = list(findings(folder, most))
            if len(found) != wanted:
                sys.exit(f"the case '{rule}' gave {found}, expected {wanted} findings")
            for file in texts:
                (folder / file).unlink()


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    if git(root, "rev-parse", "--is-shallow-repository") != "false":
        print(f"skipped: {root} has no git history, or not all of it (a shallow clone), to compare the records' commits with")
        sys.exit(SKIPPED)
    prove()
    found = list(findings(root))
    for one in found:
        print(one, file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
