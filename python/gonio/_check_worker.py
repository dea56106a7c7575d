"""The process of one check: reads a request from standard input and writes the verdict to standard output."""

from __future__ import annotations

import json
import pickle
import sys

from . import _native

_MOST_MEMORY = 6 << 30


def main() -> None:
    try:
        import resource

        # A shader may have a giant array.
        resource.setrlimit(resource.RLIMIT_AS, (_MOST_MEMORY, _MOST_MEMORY))
    except (ImportError, ValueError, OSError):
        pass  # Windows has no such limit, and a smaller one may be set already.
    # The request is from the parent process, which started this one.
    request = pickle.load(sys.stdin.buffer)
    try:
        verdict, page = _native.check_submission(*request)
        answer = {"verdict": verdict, "page": page}
    except _native.Error as error:
        answer = {"error": str(error)}
    json.dump(answer, sys.stdout)


if __name__ == "__main__":
    main()
