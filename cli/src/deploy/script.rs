//! What a robot's shell is told to do: POSIX sh with what every small Linux has.
//!
//! Invariant: every word from outside is quoted; a script that fails leaves the running version as it is.

use super::package::SUMS;

/// Versions that stay on the robot.
const KEPT: usize = 4;

/// For how many seconds a program must run before it counts as started: what lacks a device, a port or a file ends in the
/// first or second, and systemd starts it again before the next.
const WATCHED_SECONDS: u32 = 5;

/// One word for a shell, whatever is in it.
pub(crate) fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// How the robot's program is started and stopped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Service<'a> {
    /// Its file name; `None`: nothing is started.
    pub(crate) unit: Option<&'a str>,
    pub(crate) systemctl: &'a str,
}

/// Lines of a word and what it says: which machine, how much space, which version, which files of it were changed there.
pub(crate) fn probe(folder: &str) -> String {
    let (folder, changed) = (quoted(folder), changed());
    format!(
        r#"folder={folder}
mkdir -p "$folder/versions" "$folder/runs" || exit 1
echo "machine $(uname -m)"
echo "free $(df -Pk "$folder" | sed -n '2s/  */ /gp' | cut -d' ' -f4)"
command -v rsync >/dev/null && echo "rsync yes"
cd "$folder/current" 2>/dev/null || exit 0
echo "current $(pwd -P)"
{changed}"#
    )
}

/// Tells which files of a version, in its folder, are not as they were sent, by a word that other languages translate; and
/// which are gone.
fn changed() -> String {
    format!(
        r#"LC_ALL=C sha256sum -c {SUMS} 2>/dev/null | sed -n 's/^\(.*\): FAILED.*$/\1/p' |
while IFS= read -r file; do if [ -e "$file" ]; then echo "changed $file"; else echo "gone $file"; fi; done
known=$(sed 's/^[^ ]*  //' {SUMS})
find . -type f ! -name {SUMS} | grep -vxF -e "$known" | sed 's/^/changed /'
"#
    )
}

/// Makes what has arrived the running version. Exit status 3: it did not start, and the one before runs again; 4: nor does
/// that one.
pub(crate) fn switch(folder: &str, version: &str, service: Service<'_>) -> String {
    let (folder, version) = (quoted(folder), quoted(version));
    let functions = functions(service);
    format!(
        r#"folder={folder}; version={version}
{functions}
cd "$folder/versions/.incoming" || exit 1
sha256sum -c {SUMS} >/dev/null 2>&1 || {{ echo "files did not arrive whole" >&2; exit 1; }}
ln -sfn ../../runs runs || exit 1
said=$(./start --check-parameters 2>&1) || {{ echo "the program does not start, or refuses its parameters: $said" >&2; exit 1; }}
cd "$folder" || exit 1
rm -rf "versions/$version" && mv versions/.incoming "versions/$version" || exit 1
old=$(readlink current)
point current "versions/$version" || exit 1
if ! start; then
  [ -n "$old" ] || exit 3
  point current "$old" && start || exit 4
  exit 3
fi
if [ -n "$old" ]; then point previous "$old"; fi
ls -1 versions | sort -r | tail -n +{} | while read -r one; do
  case "$(readlink current) $(readlink previous)" in *"versions/$one"*) ;; *) rm -rf "versions/$one" ;; esac
done
exit 0
"#,
        KEPT + 1
    )
}

/// Makes the version before the running one; lines as those of [`probe`]: the new one, and which files of the other were
/// changed there. Exit statuses as those of [`switch`].
pub(crate) fn roll_back(folder: &str, service: Service<'_>) -> String {
    let (folder, changed) = (quoted(folder), changed());
    let functions = functions(service);
    format!(
        r#"folder={folder}
{functions}
cd "$folder" 2>/dev/null && new=$(readlink previous) && [ -d "$new" ] || {{ echo "there is no version before" >&2; exit 1; }}
old=$(readlink current)
(cd "$old" 2>/dev/null || exit 0
{changed})
point current "$new" && point previous "$old" || exit 1
if ! start; then
  point previous "$new" && point current "$old" && start || exit 4
  exit 3
fi
echo "current $new"
echo "previous $old"
"#
    )
}

/// Lines as those of [`probe`], changing nothing.
pub(crate) fn look(folder: &str, service: Service<'_>) -> String {
    let folder = quoted(folder);
    let state = service.unit.map_or_else(String::new, |unit| {
        format!(
            "echo \"state $({} is-active {} 2>&1 | tail -n 1)\"\n",
            service.systemctl,
            quoted(unit)
        )
    });
    format!(
        r#"folder={folder}
echo "machine $(uname -m)"
echo "up $(cut -d. -f1 /proc/uptime)"
echo "free $(df -Pk "$folder" 2>/dev/null | sed -n '2s/  */ /gp' | cut -d' ' -f4)"
[ -e "$folder/current" ] && echo "current $(basename "$(readlink "$folder/current")")"
[ -e "$folder/previous" ] && echo "previous $(basename "$(readlink "$folder/previous")")"
{state}exit 0
"#
    )
}

/// `point LINK TARGET` in one step, whoever looks meanwhile; `start` the current version, and see that it goes on.
fn functions(service: Service<'_>) -> String {
    let point = r#"point() { ln -sfn "$2" ".$1" && mv -T ".$1" "$1"; }"#;
    let Some(unit) = service.unit else {
        return format!("{point}\nstart() {{ :; }}");
    };
    let (systemctl, unit) = (service.systemctl, quoted(unit));
    let seconds = WATCHED_SECONDS;
    // Where a program is started again and again, most looks find it running; what systemd counts tells them apart. It counts
    // starts, too, and refuses one more after a version that ended at once: that must not keep the version before from running.
    // What stands before the last line is sudo's.
    format!(
        r#"{point}
count() {{ {systemctl} show --property=MainPID --property=NRestarts {unit} 2>&1; }}
goes_on() {{
  first=$(count); second=0
  while [ $second -lt {seconds} ]; do
    sleep 1; second=$((second + 1))
    state=$({systemctl} is-active {unit} 2>&1 | tail -n 1)
    [ "$state" = active ] || {{ echo "after $second s "{unit}" is $state" >&2; return 1; }}
    [ "$(count)" = "$first" ] || {{ echo "after $second s "{unit}" was started again" >&2; return 1; }}
  done
}}
start() {{
  said=$({{ {systemctl} enable --force "$folder/current/"{unit} && {systemctl} daemon-reload &&
    {{ {systemctl} reset-failed {unit} || :; }} && {systemctl} restart {unit}; }} 2>&1) ||
    {{ echo "$said" >&2; return 1; }}
  goes_on
}}"#
    )
}

/// One word as a person types it: quoted only where it has to be.
pub(crate) fn as_a_word(word: &str) -> String {
    let is_plain = |one: char| one.is_alphanumeric() || "/._-@:".contains(one);
    if word.chars().all(is_plain) {
        word.to_owned()
    } else {
        quoted(word)
    }
}

#[cfg(test)]
mod tests {
    use std::process::Command;

    use super::{SUMS, changed, quoted};

    #[test]
    fn what_was_changed_is_seen_whatever_language_the_robot_speaks() {
        let folder = tempfile::tempdir().expect("there is room");
        let write = |file: &str, text: &str| {
            std::fs::write(folder.path().join(file), text).expect("the folder is ours");
        };
        // Of an empty file.
        let sum = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        write(
            SUMS,
            &format!("{sum}  ./default.toml\n{sum}  ./head.toml\n"),
        );
        write("default.toml", "gain = 2\n");
        // As one that speaks German, where nobody asks it for another language.
        let german = "sha256sum() { [ \"$LC_ALL\" = C ] && word=FAILED || word=FEHLSCHLAG; \
                      command sha256sum \"$@\" | sed \"s/FAILED/$word/\"; }";
        let script = format!("{german}\n{}", changed());
        let output = Command::new("sh")
            .args(["-c", &script])
            .env("LC_ALL", "de_DE.UTF-8")
            .current_dir(folder.path())
            .output()
            .expect("there is a shell");
        let said = String::from_utf8_lossy(&output.stdout);
        assert_eq!(said, "changed ./default.toml\ngone ./head.toml\n");
    }

    #[test]
    fn a_word_stays_one_word() {
        assert_eq!(quoted("a b; rm -rf $HOME"), "'a b; rm -rf $HOME'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
    }
}
