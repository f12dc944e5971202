# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections import Counter
from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st
from trident_tool import unity_build
from trident_tool.hidden_names import hidden_names
from trident_tool.unity_build import GROUPS, LIST, Source, grouped, parse_groups, update

LARGEST = 5


def test_hidden_names_are_those_of_unnamed_namespaces_and_macros() -> None:
    text = """
    #define LIMIT 3
    int open(int x);
    namespace trident { namespace {
    constexpr double kStep = std::max(0.1, other), kEnd = 3.0;  // double kOld = 1;
    const char* kText = "int quoted() {}";
    struct Part : Base { int inner(); };
    class Tool final {};
    std::vector<int> made(int a = 3) { int local = 0; return {local}; }
    }  // namespace
    void later() {}
    }
int main() {}
    """
    assert hidden_names(text) == {
        "LIMIT",
        "int main(",
        "kStep",
        "kEnd",
        "kText",
        "Part",
        "Tool",
        "made",
    }


def test_a_test_hides_the_class_that_googletest_makes_of_it() -> None:
    text = """
    namespace {
    TEST(Sum, IsRight) { EXPECT_EQ(1 + 1, two()); }
    TEST_F(Fixture, holds) {}
    TEST_P(Each, one) {}
    INSTANTIATE_TEST_SUITE_P(All, Each, testing::Values(1, 2));
    }
    """
    assert hidden_names(text) == {
        "Sum_IsRight_Test",
        "Fixture_holds_Test",
        "Each_one_Test",
        "AllEach_instance",
    }


SOURCES = st.dictionaries(
    st.integers(0, 30).map("/src/{}.cpp".format), st.sets(st.sampled_from("abcde"), max_size=2)
)


@given(SOURCES, SOURCES)
def test_groups_stay_as_they_are_and_hide_nothing_twice(
    first: dict[str, set[str]], second: dict[str, set[str]]
) -> None:
    before = grouped(sorted(first), {}, first.__getitem__)
    after = grouped(sorted(second), before, second.__getitem__)
    assert list(after) == sorted(second)
    assert max(Counter(after.values()).values(), default=0) <= LARGEST
    hidden = Counter((group, name) for path, group in after.items() for name in second[path])
    assert all(count == 1 for count in hidden.values())
    assert grouped(sorted(second), after, second.__getitem__) == after, "nothing has changed"
    unchanged = {path for path in first if second.get(path) == first[path]}
    if unchanged == set(first):
        assert {path: after[path] for path in first} == before


def test_neighbours_come_together() -> None:
    paths = [f"/src/{i}.cpp" for i in range(12)]
    assert list(grouped(paths, {}, lambda _: set()).values()) == [0] * 5 + [1] * 5 + [2] * 2


def hide(folder: Path, name: str, hidden: str) -> Path:
    file = folder / name
    file.write_text(f"namespace {{ int {hidden}() {{ return 1; }} }}\n", encoding="utf-8")
    return file


def test_what_hides_a_name_of_its_group_anew_leaves_it(tmp_path: Path) -> None:
    files = [hide(tmp_path, name, name[0]) for name in ("a b.cpp", "c.cpp", "d.cpp")]
    sources = [Source("lib", str(file)) for file in files]
    (tmp_path / LIST).write_text("".join(f"{s.target}\t{s.path}\n" for s in sources))
    assert update(tmp_path)
    assert parse_groups((tmp_path / GROUPS).read_text()) == dict.fromkeys(sources, 0)
    assert not update(tmp_path), "as it was"
    hide(tmp_path, "c.cpp", "a")
    assert update(tmp_path)
    groups = parse_groups((tmp_path / GROUPS).read_text())
    assert [groups[source] for source in sources] == [0, 1, 0]
    calls = [line.partition("(")[0] for line in (tmp_path / GROUPS).read_text().splitlines()]
    assert calls == ["trident_unity_group", "trident_unity_alone", "trident_unity_group"]


def test_a_build_that_joins_nothing_is_left_alone(tmp_path: Path) -> None:
    assert not update(tmp_path)
    assert not (tmp_path / GROUPS).exists()


def test_sources_of_two_targets_are_grouped_apart(tmp_path: Path) -> None:
    file = str(hide(tmp_path, "a.cpp", "f"))
    (tmp_path / LIST).write_text(f"lib\t{file}\ntest\t{file}\n")
    assert unity_build.main([str(tmp_path)]) == 0
    expected = {Source("lib", file): 0, Source("test", file): 0}
    assert parse_groups((tmp_path / GROUPS).read_text()) == expected
