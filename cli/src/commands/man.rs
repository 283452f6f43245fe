//! `man`: manual pages, made of what `--help` says.

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

/// The page of a command, or of hulkgen itself, as roff.
fn page(name: Option<&str>) -> Result<String, Refusal> {
    let mut whole = Arguments::command();
    // Gives every command its full name and the options that all of them have.
    whole.build();
    let command = match name {
        None => whole,
        Some(name) => match whole.find_subcommand(name) {
            Some(command) => command.clone(),
            None => return Err(unknown(&whole, name)),
        },
    };
    let title = match name {
        None => "hulkgen".to_owned(),
        Some(name) => format!("hulkgen-{name}"),
    };
    let mut page = Vec::new();
    clap_mangen::Man::new(command)
        .title(title)
        .date("")
        .render(&mut page)
        .map_err(|error| Refusal::bad(format!("cannot write the page: {error}")))?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}

fn unknown(whole: &clap::Command, name: &str) -> Refusal {
    let names = whole.get_subcommands().map(clap::Command::get_name);
    let refusal = Refusal::wrong_usage(format!("there is no command `{name}`"));
    refusal.help(suggestion(name, names, "there are"))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::page;
    use crate::arguments::Arguments;

    #[test]
    fn every_command_has_a_page_with_its_examples() {
        for command in Arguments::command().get_subcommands() {
            let page = page(Some(command.get_name())).expect("the command is there");
            assert!(page.contains("Exit status"), "{page}");
            assert!(page.contains(".SH SYNOPSIS"), "{page}");
        }
        assert!(page(None).expect("hulkgen").contains("add\\-node"));
    }

    #[test]
    fn a_misspelt_command_is_refused_with_the_nearest() {
        let refusal = page(Some("explan")).expect_err("there is none");
        assert_eq!(refusal.help.as_deref(), Some("did you mean `explain`?"));
    }
}
