#!/usr/bin/env python3
"""Prints how many test cases of a CTest report (JUnit) passed, failed and were skipped.

A test that could not be run at all (its program is missing) counts as failed; so does a report
that is not there. Usage: count_tests.py tests.xml
"""
import sys
import xml.etree.ElementTree as xml


def verdict(case):
    if case.get("status") == "run":
        return "passed"
    reason = case.find("skipped")
    wanted = reason is not None and reason.get("message", "").startswith("SKIP_")
    return "skipped" if wanted or case.get("status") == "disabled" else "failed"


def main():
    try:
        verdicts = [verdict(case) for case in xml.parse(sys.argv[1]).iter("testcase")]
    except (OSError, xml.ParseError) as error:
        print(f"no report of the tests: {error}", file=sys.stderr)
        verdicts = ["failed"]
    print(*(verdicts.count(name) for name in ("passed", "failed", "skipped")))


main()
