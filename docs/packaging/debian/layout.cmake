# Where Debian differs from other systems: compressed pages, and the folder of zsh's completions.
set(share "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share")
execute_process(COMMAND gzip -9n ${share}/man/man1/isojam.1 ${share}/doc/isojam/changelog.Debian
                COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
