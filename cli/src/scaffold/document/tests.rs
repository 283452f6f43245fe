//! Lists in every layout that people write.

use super::{list, parse, push, remove};

fn edited(text: &str, edit: impl Fn(&mut toml_edit::Array)) -> String {
    let mut document = parse("hulk.toml".into(), text).expect("it is TOML");
    edit(list(document.as_table_mut(), "nodes").expect("it is a list"));
    document.to_string()
}

#[test]
fn an_element_is_added_in_the_layout_of_the_list() {
    for (before, after) in [
        ("nodes = []\n", "nodes = [\"c\"]\n"),
        ("nodes = [\"a\"]\n", "nodes = [\"a\", \"c\"]\n"),
        (
            "nodes = [ \"a\", \"b\" ] # two\n",
            "nodes = [ \"a\", \"b\", \"c\" ] # two\n",
        ),
        (
            "nodes = [\n    \"a\",\n]\n",
            "nodes = [\n    \"a\",\n    \"c\",\n]\n",
        ),
        (
            "nodes = [\n  \"a\",\n  \"b\"\n]\n",
            "nodes = [\n  \"a\",\n  \"b\",\n  \"c\"\n]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    # second\n    \"b\", # last\n]\n",
            "nodes = [\n    \"a\", # first\n    # second\n    \"b\", # last\n    \"c\",\n]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    # \"old\",\n]\n",
            "nodes = [\n    \"a\", # first\n    # \"old\",\n    \"c\",\n]\n",
        ),
        ("kind = \"x\"\n", "kind = \"x\"\nnodes = [\"c\"]\n"),
    ] {
        assert_eq!(edited(before, |list| push(list, "c")), after);
    }
}

#[test]
fn an_element_is_removed_with_the_comment_beside_it_alone() {
    for (before, index, after) in [
        ("nodes = [\"a\", \"b\"]\n", 0, "nodes = [\"b\"]\n"),
        ("nodes = [\"a\", \"b\"]\n", 1, "nodes = [\"a\"]\n"),
        ("nodes = [\"a\"]\n", 0, "nodes = []\n"),
        ("nodes = [\n    \"a\",\n]\n", 0, "nodes = []\n"),
        (
            "nodes = [\n    \"a\",\n    \"b\",\n]\n",
            1,
            "nodes = [\n    \"a\",\n]\n",
        ),
        (
            "nodes = [\n    \"a\",\n    \"b\"\n]\n",
            1,
            "nodes = [\n    \"a\"\n]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    # second\n    \"b\", # beside\n    \"c\",\n]\n",
            1,
            "nodes = [\n    \"a\", # first\n    # second\n    \"c\",\n]\n",
        ),
        (
            "nodes = [\n    \"a\",\n    # \"old\",\n    \"b\",\n]\n",
            1,
            "nodes = [\n    \"a\",\n    # \"old\",\n]\n",
        ),
        (
            "nodes = [\n    # above\n    \"a\", # beside\n    # below\n]\n",
            0,
            "nodes = [\n    # above\n    # below\n]\n",
        ),
        (
            "nodes = [\n    # above\n    \"a\", # beside\n    # between\n    \"b\"]\n",
            0,
            "nodes = [\n    # above\n    # between\n    \"b\"]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    # above\n    \"b\", \"c\",\n]\n",
            1,
            "nodes = [\n    \"a\", # first\n    # above\n    \"c\",\n]\n",
        ),
        (
            "nodes = [\n    \"a\",\n    # above\n    \"b\"]\n",
            1,
            "nodes = [\n    \"a\"\n    # above\n]\n",
        ),
        (
            "nodes = [\n    \"a\", # first\n    \"b\", # beside\n]\n",
            1,
            "nodes = [\n    \"a\", # first\n]\n",
        ),
    ] {
        assert_eq!(
            edited(before, |list| remove(list, index)),
            after,
            "{before}"
        );
    }
}

#[test]
fn what_is_added_and_removed_again_leaves_no_trace() {
    for before in [
        "nodes = []\n",
        "nodes = [\"a\"]\n",
        "nodes = [\n    \"a\",\n]\n",
        "nodes = [\n    \"a\", # first\n    # the list's\n]\n",
        "nodes = [\n    \"a\",\n    # \"old\",\n    \"b\", # beside\n]\n",
    ] {
        let added = edited(before, |list| push(list, "c"));
        let index = added.matches('"').count() / 2 - added.matches("# \"").count() - 1;
        assert_eq!(
            edited(&added, |list| remove(list, index)),
            before,
            "{added}"
        );
    }
}
