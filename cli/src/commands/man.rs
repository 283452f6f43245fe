//! `man`: manual pages, made of what `--help` says.

use std::io;

use clap::CommandFactory as _;

use super::terminal::Terminal;
use crate::arguments::{Arguments, Man};
use crate::diagnostics::suggestion;
use crate::outcome::{Outcome, Refusal};

pub(super) fn run(terminal: &Terminal, man: &Man) -> Result<Outcome, Refusal> {
    let page = page(man.command.as_deref())?;
    terminal.data(&page)?;
    Ok(Outcome::Good)
}

/// Lines that define the apostrophe: with groff, and without.
const APOSTROPHES: usize = 2;

/// The page of a command, or of hulkgen itself, as roff.
fn page(name: Option<&str>) -> Result<String, Refusal> {
    let mut whole = Arguments::command().disable_help_subcommand(true);
    // Gives every command its full name and the options that all of them have.
    whole.build();
    let command = match name {
        None => whole,
        Some(name) => match whole.find_subcommand(name) {
            Some(command) => command.clone(),
            None => return Err(unknown(&whole, name)),
        },
    };
    let ending = command.get_after_help().map(ToString::to_string);
    let page = beginning(command, name)
        .map_err(|error| Refusal::bad(format!("cannot write the page: {error}")))?;
    let page = String::from_utf8_lossy(&page);
    let mut lines: Vec<&str> = page.lines().collect();
    // Each section defines the apostrophe anew.
    let mut defined = 0;
    lines.retain(|line| {
        let defines = line.contains(".ds Aq ");
        defined += usize::from(defines);
        !defines || defined <= APOSTROPHES
    });
    let mut text = lines.join("\n") + "\n";
    text.push_str(&sections(&ending.unwrap_or_default()));
    Ok(text)
}

/// Everything up to the options and commands.
fn beginning(mut command: clap::Command, name: Option<&str>) -> io::Result<Vec<u8>> {
    let title = match name {
        None => "hulkgen".to_owned(),
        Some(name) => format!("hulkgen-{name}"),
    };
    let source = format!("hulkgen {}", env!("CARGO_PKG_VERSION"));
    // As `--help` has it, instead of a list of all options without their values.
    let usage = command.render_usage().to_string();
    let usage = usage.trim_start_matches("Usage: ").to_owned();
    let has_commands = command.has_subcommands();
    let manual = clap_mangen::Man::new(command.override_usage(usage))
        .title(title)
        .date("")
        .source(source)
        .manual("hulkgen");
    let mut page = Vec::new();
    manual.render_title(&mut page)?;
    manual.render_name_section(&mut page)?;
    manual.render_synopsis_section(&mut page)?;
    manual.render_description_section(&mut page)?;
    manual.render_options_section(&mut page)?;
    if has_commands {
        manual.render_subcommands_section(&mut page)?;
    }
    Ok(page)
}

/// What `--help` ends with: a paragraph is a section, and where its first line is only the heading, its lines stay lines.
fn sections(ending: &str) -> String {
    let mut page = String::new();
    for paragraph in ending.split("\n\n") {
        let Some((heading, text)) = paragraph.split_once(':') else {
            continue;
        };
        page.push_str(&format!(".SH \"{}\"\n", heading.to_uppercase()));
        match text.strip_prefix('\n') {
            Some(lines) => {
                let lines = lines.lines().map(|line| escaped(line.trim_start()) + "\n");
                page.push_str(&format!(".nf\n{}.fi\n", lines.collect::<String>()));
            }
            None => {
                let lines = text.lines().map(|line| escaped(line.trim()) + "\n");
                page.extend(lines);
            }
        }
    }
    page
}

/// A line of text that roff prints as it is, so that it can be copied into a shell.
fn escaped(line: &str) -> String {
    let mut text = String::new();
    for character in line.chars() {
        match character {
            '\\' => text.push_str("\\e"),
            '-' => text.push_str("\\-"),
            '\'' => text.push_str("\\(aq"),
            '`' => text.push_str("\\(ga"),
            '^' => text.push_str("\\(ha"),
            '~' => text.push_str("\\(ti"),
            character => text.push(character),
        }
    }
    if text.starts_with('.') {
        text.insert_str(0, "\\&");
    }
    text
}

fn unknown(whole: &clap::Command, name: &str) -> Refusal {
    let names = whole.get_subcommands().map(clap::Command::get_name);
    let refusal = Refusal::wrong_usage(format!("there is no command `{name}`"));
    refusal.help(suggestion(name, names, "there are"))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::{page, sections};
    use crate::arguments::Arguments;

    #[test]
    fn every_command_has_a_page_with_its_examples() {
        for command in Arguments::command().get_subcommands() {
            let page = page(Some(command.get_name())).expect("the command is there");
            assert!(page.contains(".SH \"EXIT STATUS\""), "{page}");
            assert!(page.contains(".SH SYNOPSIS"), "{page}");
        }
        assert!(page(None).expect("hulkgen").contains("add\\-node"));
    }

    #[test]
    fn what_can_be_copied_stays_as_it_is() {
        let ending = "Exit status: 0 good,\n             1 bad.\n\nExample:\n  a | jq '.b'   # c-d";
        assert_eq!(
            sections(ending),
            ".SH \"EXIT STATUS\"\n0 good,\n1 bad.\n.SH \"EXAMPLE\"\n.nf\na | jq \\(aq.b\\(aq   # c\\-d\n.fi\n"
        );
    }

    #[test]
    fn a_misspelt_command_is_refused_with_the_nearest() {
        let refusal = page(Some("explan")).expect_err("there is none");
        assert_eq!(refusal.help.as_deref(), Some("did you mean `explain`?"));
    }
}
