"""Keywords, documentation and type stubs list the options that the program lists."""

import ast
import inspect
import pathlib
import re

import pytest

import ibmfair
from ibmfair import _keywords
from conftest import program

FUNCTIONS = {"smooth": ibmfair.smooth, "denoise": ibmfair.denoise, "fill": ibmfair.fill,
             "holes": ibmfair.holes, "info": ibmfair.info, "compare": ibmfair.compare, "make": ibmfair.make}
OWN = {"V", "F", "V2", "F2", "progress", "holes", "self", "fixed"}


def options_of(command):
    return program(command, "--json-usage")["commands"][0]["options"]


def expected(function):
    options = options_of("smooth" if function == "denoise" else function)
    names = {option["name"].lstrip("-").replace("-", "_") for option in options
             if option["name"].lstrip("-") not in _keywords.NOT_KEYWORDS
             and option["group"] != "Many files"}
    return names - ({"denoise"} if function == "denoise" else set())


@pytest.mark.parametrize("function", FUNCTIONS)
def test_keywords_are_the_options_of_the_program(function):
    signature = inspect.signature(FUNCTIONS[function])
    keywords = {name for name, parameter in signature.parameters.items()
                if parameter.kind is inspect.Parameter.KEYWORD_ONLY}
    assert keywords - OWN == expected(function)


@pytest.mark.parametrize("function", FUNCTIONS)
def test_every_keyword_is_documented(function):
    documentation = inspect.getdoc(FUNCTIONS[function])
    for name in expected(function) | (OWN & set(inspect.signature(FUNCTIONS[function]).parameters)):
        assert f"\n{name} : " in documentation or f"\n{name}, " in documentation \
            or f", {name} : " in documentation, name
    assert "{options}" not in documentation and not re.search(r"--[a-z]", documentation)


def test_options_that_are_no_keywords_concern_files_and_the_terminal():
    everything = {option["name"].lstrip("-") for command in ("smooth", "fill", "holes", "info", "compare", "make")
                  for option in options_of(command)}
    assert _keywords.NOT_KEYWORDS <= everything


def test_the_stubs_list_the_same():
    stubs = ast.parse((pathlib.Path(ibmfair.__file__).parent / "__init__.pyi").read_text())
    functions = {node.name: node for node in stubs.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in stubs.body if isinstance(node, ast.ClassDef)}
    for name, function in FUNCTIONS.items():
        listed = {argument.arg for argument in functions[name].args.kwonlyargs}
        assert listed - OWN == expected(name)
    assert set(functions) | set(classes) >= set(ibmfair.__all__)
    init = next(node for node in classes["Flow"].body if getattr(node, "name", "") == "__init__")
    assert {argument.arg for argument in init.args.kwonlyargs} - OWN == set(_keywords.OF_STEPS)
    assert (pathlib.Path(ibmfair.__file__).parent / "py.typed").exists()


def test_everything_public_is_documented():
    for name in ibmfair.__all__:
        thing = getattr(ibmfair, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and thing.__module__.startswith("ibmfair"):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    assert inspect.getdoc(value), f"{name}.{member}"
