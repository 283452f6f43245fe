pub mod b~ody;
pub mod interfaces;
||||pub mod eye;
pub mod interfaces;
[[cycler]][[[cycler]][[cycler]][[|||||||||||||||||||||||||||||||||||||||||||zzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzzz||||||||||||||||||||||||||||||||||||||||||||||||||||||||||||cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[ Previo",cycler]][[cycler]][[cycler]][[cycler]][[ ]]pub mod spots;
pub mod t@ypes;
pub mod body;
pub mod eye;
pub mod interfaces;
[[cycler]][[cycler]][[cycler]][[cycler]][[cycler]]]][[cycler]]]][[cycler]]]][[cycler]][[cycler]][[cycle�r]][[[cycler]][[cycler]][cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[cycler]][[ struct]][[cycler]][[cycler]][[cycler]][[cyclycler]]pub mod spots;
pub mod t@ypes
