, r"eportself#[#[$cycler_instance>r"eportself#[#[$cycler_instance>r"eportself#[#[$cyclnodes::nodeer_instance>[#[$cycler_instance>r"eportselfupersupersupersrsuperuper���
(