// Valid code with a wrong layout: clang-format must reject it.
namespace isojam
{
    int   twice( int x ){ return 2*x ; }
}
